// Shows the pose of the camera in space. Output lines contain this pose if `--pose space` is given.
import { fromWorld, type Quaternion, type SpacePose } from "../page/lean.js";
import { SpacePanel, type ShownPose } from "../page/space_panel.js";
import type { Line } from "./messages.js";

const kDegrees = 180 / Math.PI;

/**
 * Returns a pose from an output line, with its covariance converted from degrees to radians. Returns null if the line
 * does not contain the pose.
 */
function poseOf(z_mm?: number | null, quaternion?: Quaternion | null, covariance?: number[] | null): SpacePose | null {
    if (typeof z_mm !== "number" || !quaternion || !covariance) return null;
    const inRad = covariance.map((value, i) => value / ((i % 6 < 3 ? 1 : kDegrees) * (i < 18 ? 1 : kDegrees)));
    return { height_mm: -z_mm, quaternion_xyzw: quaternion, covariance: inRad };
}

/** Returns the tracked pose, or the pose of the frame if the camera is not tracked. */
function shownPose(line: Line): ShownPose {
    const { camera_track_z_m: z_m, camera_track_quaternion_world_xyzw: quaternion } = line;
    if (typeof z_m === "number" && quaternion) {
        const pose = fromWorld(z_m, quaternion, line.camera_track_covariance_m_rad!);
        return { pose, source: "tracked", is_in_world: true };
    }
    const tracked = poseOf(line.camera_track_z_mm, line.camera_track_quaternion_xyzw, line.camera_track_covariance_mm_deg);
    if (tracked) return { pose: tracked, source: "tracked", is_in_world: false };
    const pose = poseOf(line.camera_z_mm, line.camera_quaternion_xyzw, line.camera_covariance_mm_deg);
    return { pose, source: pose ? "of this frame" : "", is_in_world: false };
}

const panel = new SpacePanel("live");

/** Shows the pose from an output line. Without `--pose space`, the panel is hidden. */
export function showSpace(line: Line): void {
    panel.show(shownPose(line));
}

// Tracker: follows a robot from frame to frame.
import { callOk, coreModule } from "./core.js";
import type { Fix } from "./fix.js";
import { kFixBytes } from "./fix_fields.js";
import { Instance, type WasmSource } from "./instance.js";
import { kMotionBytes, writeMotion, type MeasuredMotion } from "./measured_motion.js";
import { kTrackEvents, kVerdicts, type Code, type TrackEvent, type Verdict } from "./names.js";
import { newLocator } from "./new_locator.js";
import { kPredictionBytes, type Prediction } from "./prediction.js";

/**
 * Options of a tracker: limits on the robot's motion, and criteria for accepting fixes.
 * docs/tracking.md explains the options.
 */
export interface TrackOptions {
    /** Standard deviation of the acceleration while the robot manoeuvres. Default: 600. */
    acceleration_mm_s2?: number;
    /** Standard deviation of the angular acceleration while the robot manoeuvres. Default: 6. */
    angular_acceleration_rad_s2?: number;
    /** Maximum possible acceleration of the robot, for example in a collision. Default: 10000. */
    max_acceleration_mm_s2?: number;
    /** Maximum angular acceleration. Default: 200. */
    max_angular_acceleration_rad_s2?: number;
    /** Maximum speed. Default: 1000. */
    max_speed_mm_s?: number;
    /** Maximum turn rate. Default: 20. */
    max_turn_rad_s?: number;
    /**
     * Tolerance by which a fix may exceed the limits of motion, in standard deviations of the
     * innovation. Default: 5.
     */
    gate_sigmas?: number;
    /** Number of consecutive consistent fixes that confirm a jump. Default: 3. */
    confirmations?: number;
    /** Maximum movement of a stationary robot, along each axis. Default: 0.1. */
    still_mm?: number;
    /** Maximum turn of a stationary robot. Default: 0.02. */
    still_rad?: number;
    /** Standard deviation of printing errors, which do not average out. Default: 0.0002. */
    min_sigma_mm?: number;
    /** Standard deviation of the angle due to printing errors. Default: 0.00002. */
    min_sigma_rad?: number;
    /** Log2 of the maximum probability that an accepted fix is wrong. Default: -30. */
    max_p_wrong_log2?: number;
    /**
     * Maximum log2 of `p_wrong`, computed without the prior, at which a weak fix can be accepted.
     * Must be at most -1. Default: -10.
     */
    max_weak_p_wrong_log2?: number;
    /** Spacing of the printed grid. Default: 0.508. */
    spacing_mm?: number;
    /**
     * Time after which the robot is lost if there is neither an accepted fix nor a motion. Default:
     * 70000.
     */
    lost_after_us?: number;
    /** Time without movement after which the robot is considered stationary. Default: 500000. */
    stationary_after_us?: number;
    /**
     * Maximum standard deviation of the position while only motions update the pose. Above this
     * limit, the robot is lost. Default: 5.
     */
    max_sigma_mm?: number;
    /** The core module, as in the options of Locator.create. */
    wasm?: WasmSource;
}

/** State of the robot after a frame. The pose is NaN while the robot is lost. */
export interface Track {
    /** Time of the pose. */
    time_us: number;
    /** True if the robot is lost: no fix accepted for too long, or the pose is too uncertain. */
    is_lost: boolean;
    /** True if the robot is at rest. */
    is_stationary: boolean;
    /** Verdict of the tracker on the fix of the frame. */
    verdict: Verdict;
    /** Changes caused by the frame. */
    events: TrackEvent[];
    /** Upper bound on the probability that the pose is wrong, given the previous frames. */
    p_wrong: number;
    /** x in the pattern, to the right. */
    x_mm: number;
    /** y in the pattern, DOWN the page. */
    y_mm: number;
    /** Angle of the image x axis, from +x towards +y, in [-pi, pi). */
    theta_rad: number;
    /** Velocity along x. */
    vx_mm_s: number;
    /** Velocity along y. */
    vy_mm_s: number;
    /** Turn rate. */
    turn_rad_s: number;
    /** Covariance of x, y, theta and their velocities, in mm, rad and s: 36 numbers, row by row. */
    covariance: Float32Array;
}

type Numbers = Omit<TrackOptions, "wasm">;

/** Sizes of structs in wrappers/c/dotpose.h, and offsets of their members. */
const kOptionsBytes = 88;
const kFloats: Partial<Record<keyof Numbers, number>> = {
    acceleration_mm_s2: 4,
    angular_acceleration_rad_s2: 8,
    max_acceleration_mm_s2: 12,
    max_angular_acceleration_rad_s2: 16,
    max_speed_mm_s: 20,
    max_turn_rad_s: 24,
    gate_sigmas: 28,
    still_mm: 36,
    still_rad: 40,
    min_sigma_mm: 44,
    min_sigma_rad: 48,
    spacing_mm: 60,
    max_sigma_mm: 80,
};
const kInts: Partial<Record<keyof Numbers, number>> = {
    confirmations: 32,
    max_p_wrong_log2: 52,
    max_weak_p_wrong_log2: 56,
};
const kTimes: Partial<Record<keyof Numbers, number>> = { lost_after_us: 64, stationary_after_us: 72 };
const kTrackerBytes = 1728;
const kSightingBytes = 80;
const kTrackBytes = 232;

/**
 * Follows a robot, using the fixes of its frames and odometry.
 *
 *     const tracker = await Tracker.create();
 *     const fix = locator.locate(image, { prediction: tracker.predict(time_us) });
 *     const track = tracker.update(time_us, fix);
 *
 * With odometry, the tracker also follows the robot across areas without a pattern:
 *
 *     const track = tracker.update(time_us, locator.locate(image, { motion }), motion);
 */
export class Tracker {
    readonly #core: Instance;
    readonly #tracker: number;
    readonly #fix: number;
    readonly #sighting: number;
    readonly #motion: number;
    readonly #track: number;
    readonly #prediction: number;
    /**
     * A locator for each code. The locators only provide options for predictions. They do not
     * locate frames.
     */
    readonly #locators = new Map<Code, number>();
    /** Code of the newest fix. */
    #code: Code | undefined;
    #is_lost = true;

    private constructor(core: Instance, options: Numbers) {
        this.#core = core;
        this.#tracker = core.reserve(kTrackerBytes);
        this.#fix = core.reserve(kFixBytes);
        this.#sighting = core.reserve(kSightingBytes);
        this.#motion = core.reserve(kMotionBytes);
        this.#track = core.reserve(kTrackBytes);
        this.#prediction = core.reserve(kPredictionBytes);
        const given = core.reserve(kOptionsBytes);
        callOk(core, "dotpose_track_options_init", given, kOptionsBytes);
        writeOptions(options, core.view(given, kOptionsBytes));
        callOk(core, "dotpose_tracker_init", this.#tracker, given);
    }

    /** Creates a tracker in the `lost` state. Throws RangeError for invalid options. */
    static async create({ wasm, ...options }: TrackOptions = {}): Promise<Tracker> {
        return new Tracker(await Instance.start(await coreModule(wasm)), options);
    }

    /**
     * Updates the tracker with a frame. `time_us` is the frame's time on any clock, as a whole
     * number. The fix need not be ok. `motion` is the motion since the previous update. Without a
     * fix, the pose is updated with the motion. A frame that is not newer than the previous frame
     * is ignored.
     */
    update(time_us: number, fix?: Fix | null, motion?: MeasuredMotion | null): Track {
        const time = timeOf(time_us);
        if (motion) writeMotion(motion, this.#core.view(this.#motion, kMotionBytes));
        if (fix?.ok) {
            this.#core.bytes(this.#fix, kFixBytes).set(fix.bytes);
            callOk(this.#core, "dotpose_sighting_of", this.#fix, time, this.#sighting);
            this.#code = fix.code;
        }
        const frame = [this.#tracker, time, fix?.ok ? this.#sighting : 0];
        if (motion) callOk(this.#core, "dotpose_tracker_update_moved", ...frame, this.#motion, this.#track);
        else callOk(this.#core, "dotpose_tracker_update", ...frame, this.#track);
        const track = trackOf(this.#core.view(this.#track, kTrackBytes));
        this.#is_lost = track.is_lost;
        return track;
    }

    /**
     * Predicts the position of the pattern in the frame at `time_us`. Returns null while the robot
     * is lost.
     */
    predict(time_us: number): Prediction | null {
        const code = this.#code;
        if (this.#is_lost || code === undefined) return null;
        const locator = this.#locators.get(code) ?? newLocator(this.#core, { code });
        this.#locators.set(code, locator);
        const frame = [this.#tracker, timeOf(time_us), this.#fix, this.#sighting];
        callOk(this.#core, "dotpose_tracker_predict", ...frame, locator, this.#prediction);
        return { code, bytes: this.#core.bytes(this.#prediction, kPredictionBytes).slice() };
    }
}

function timeOf(time_us: number): bigint {
    if (!Number.isSafeInteger(time_us)) throw new RangeError(`time_us must be a whole number, not ${String(time_us)}`);
    return BigInt(time_us);
}

function writeOptions(options: Numbers, view: DataView): void {
    for (const [key, value] of Object.entries(options)) {
        const name = key as keyof Numbers;
        if (value === undefined) continue;
        const [float, int, time] = [kFloats[name], kInts[name], kTimes[name]];
        if (float === undefined && int === undefined && time === undefined)
            throw new RangeError(`a tracker has no option '${key}'`);
        if (float === undefined ? !Number.isSafeInteger(value) : !Number.isFinite(value))
            throw new RangeError(`${key} must be a ${float === undefined ? "whole " : ""}number, not ${String(value)}`);
        if (float !== undefined) view.setFloat32(float, value, true);
        if (int !== undefined) view.setInt32(int, value, true);
        if (time !== undefined) view.setBigInt64(time, BigInt(value), true);
    }
}

/** Reads a dotpose_track. */
function trackOf(view: DataView): Track {
    const int = (offset: number) => view.getInt32(offset, true);
    const is_lost = int(76) !== 0;
    const float = (offset: number) => (is_lost ? NaN : view.getFloat32(offset, true));
    const double = (offset: number) => (is_lost ? NaN : view.getFloat64(offset, true));
    return {
        time_us: Number(view.getBigInt64(0, true)),
        is_lost,
        is_stationary: int(80) !== 0,
        verdict: kVerdicts[int(72)]!,
        events: kTrackEvents.filter((_, bit) => (int(84) >> bit) & 1),
        p_wrong: 2 ** int(68),
        x_mm: double(8),
        y_mm: double(16),
        theta_rad: double(24),
        vx_mm_s: float(56),
        vy_mm_s: float(60),
        turn_rad_s: float(64),
        covariance: Float32Array.from({ length: 36 }, (_, i) => float(88 + 4 * i)),
    };
}

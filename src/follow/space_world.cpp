// Converts sightings and tracks of a camera in space between sheet coordinates and world
// coordinates.
#include <cmath>

#include <Eigen/Core>

#include "dotpose/tools/space_track.hpp"

namespace dotpose {
namespace {

using RowMatrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

/// Returns m * covariance * m'.
SpaceCovariance propagated(const RowMatrix6& m, const SpaceCovariance& covariance) {
    SpaceCovariance result{};
    Eigen::Map<RowMatrix6>(result.front().data()) =
        m * Eigen::Map<const RowMatrix6>(covariance.front().data()) * m.transpose();
    return result;
}

/// Returns the pose in the world, with y down and z into the paper. `camera` is in the sheet frame.
CameraInSpace on_world_plane(const CameraInSpace& camera, const WorldPose& page) {
    // Yaw is positive counter-clockwise, but angles are positive clockwise if y points down.
    const double c = std::cos(page.yaw_rad);
    const double s = std::sin(page.yaw_rad);
    const double half_w = std::cos(page.yaw_rad / 2);
    const double half_z = -std::sin(page.yaw_rad / 2);
    const Quaternion& q = camera.rotation;
    Quaternion turned = {half_w * q.w - half_z * q.z, half_w * q.x - half_z * q.y,
                         half_w * q.y + half_z * q.x, half_w * q.z + half_z * q.w};
    if (turned.w < 0) turned = {-turned.w, -turned.x, -turned.y, -turned.z};
    return {c * camera.x_mm + s * camera.y_mm + 1000 * page.x_m,
            -s * camera.x_mm + c * camera.y_mm - 1000 * page.y_m, camera.z_mm, turned};
}

}  // namespace

std::optional<SpaceSighting> world_sighting(const SpacePose& pose, const SheetPlace& place,
                                            std::int64_t time_us) {
    if (!place.entry->world) return std::nullopt;
    const WorldPose& page = *place.entry->world;
    const auto converted = [&](const CameraInSpace& camera) {
        return on_world_plane(on_sheet(camera, *place.entry), page);
    };
    RowMatrix6 turn = RowMatrix6::Identity();
    turn(0, 0) = turn(1, 1) = std::cos(page.yaw_rad);
    turn(0, 1) = std::sin(page.yaw_rad);
    turn(1, 0) = -turn(0, 1);
    SpaceSighting sighting = sighting_of(pose, time_us);
    sighting.camera = converted(pose.camera);
    sighting.covariance = propagated(turn, pose.covariance);
    if (sighting.second) sighting.second->camera = converted(pose.second->camera);
    return sighting;
}

std::optional<CameraMotion> motion_of(const SpaceTrack& track) {
    if (track.is_lost) return std::nullopt;
    RowMatrix6 to_m = RowMatrix6::Identity();
    to_m.diagonal() << 1e-3, -1e-3, -1e-3, 1, 1, 1;
    const auto& [vx, vy, vz] = track.velocity_mm_s;
    return CameraMotion{in_world(track.camera, track.covariance, WorldPose{}),
                        {vx / 1000, -vy / 1000, -vz / 1000},
                        track.turn_rad_s,
                        propagated(to_m, track.velocity_covariance)};
}

}  // namespace dotpose

// Fits a pose in space to the dots in a frame, and converts poses between coordinate frames.
#include "dotpose/tools/space_pose.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "calibrate/dots_in_view.hpp"
#include "calibrate/located_frame.hpp"
#include "calibrate/space_fit.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond eigen_of(const Quaternion& q) {
    return {q.w, q.x, q.y, q.z};
}

Quaternion quaternion_of(Quaterniond q) {
    q.normalize();
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    return {q.w(), q.x(), q.y(), q.z()};
}

CameraInSpace camera_of(const SpaceState& state, const Vector3d& origin_mm) {
    const Vector3d position = state.position_mm + origin_mm;
    return {position.x(), position.y(), position.z(), quaternion_of(Quaterniond(state.rotation))};
}

/// Adds the map error in the view to the covariance of the pose. A map error that shifts and
/// rotates the dots in the view shifts and rotates the camera by the same amount. `middle_mm` is
/// the position of the fix, in the coordinates of `fit.state`.
void add_error_of_map(const MapPage& map, const Fix& fix, const Vector3d& spacing_mm,
                      const Vector3d& middle_mm, SpaceFit& fit) {
    const auto error = map.error_covariance({fix.cell, fix.section});
    Matrix3d covariance;
    for (Eigen::Index i = 0; i < 3; ++i) {
        for (Eigen::Index j = 0; j < 3; ++j)
            covariance(i, j) = error[std::size_t(i)][std::size_t(j)];
    }
    const Vector3d arm = fit.state.position_mm - middle_mm;
    Eigen::Matrix<double, 6, 3> by_error = Eigen::Matrix<double, 6, 3>::Zero();
    by_error(0, 0) = spacing_mm.x();
    by_error(1, 1) = spacing_mm.y();
    by_error.topRightCorner<3, 1>() = Vector3d::UnitZ().cross(arm);
    by_error.bottomRightCorner<3, 1>() = fit.state.rotation.transpose() * Vector3d::UnitZ();
    fit.covariance += by_error * covariance * by_error.transpose();
}

}  // namespace

CameraLean lean_of(const Quaternion& rotation) {
    // Rotation = (rotation by the tilt about an axis in the paper) * (turn about the optical axis).
    const auto [w, x, y, z] = rotation;
    const double turn = 2 * std::atan2(z, w);
    // The optical axis in the coordinate frame of the paper. The direction in which the camera
    // leans is opposite to the direction of the axis on the paper.
    const Vector3d axis = eigen_of(rotation) * Vector3d::UnitZ();
    return {std::atan2(axis.head<2>().norm(), axis.z()), std::atan2(-axis.y(), -axis.x()),
            turn > std::numbers::pi ? turn - 2 * std::numbers::pi : turn};
}

void require_focal_length(const Camera& camera) {
    if (pinhole_of(camera)) return;
    throw BadArgument(
        "the camera file has no focal_px, so there is no pose in space: calibrate with frames in "
        "which the camera is tilted by 10 to 30 degrees in different directions");
}

std::optional<SpacePose> space_pose(const Fix& fix, const Camera& camera, const ImageView& image,
                                    const Trace& trace, const AxisScale& print,
                                    const MapPage* map) {
    require_focal_length(camera);
    if (fix.status != Status::ok || fix.spacing_nm <= 0) return std::nullopt;
    const double x_mm = fix.spacing_mm() * print.x;
    const double y_mm = fix.spacing_mm() * print.y;
    auto fit = fit_to_image(image, {camera, *pinhole_of(camera), {x_mm, y_mm}, map}, trace);
    if (!fit) return std::nullopt;
    const Cell start = trace.decoding.place.cell;
    if (map != nullptr) {
        const Vector3d middle_mm(x_mm * (steps(start.x, fix.cell.x) + fix.fraction_x_q16 / 65536.0),
                                 y_mm * (steps(start.y, fix.cell.y) + fix.fraction_y_q16 / 65536.0),
                                 0);
        add_error_of_map(*map, fix, {x_mm, y_mm, 0}, middle_mm, *fit);
    }
    const Vector3d origin_mm(x_mm * start.x, y_mm * start.y, 0);
    SpacePose pose;
    pose.camera = camera_of(fit->state, origin_mm);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            pose.covariance[i][j] = fit->covariance(Eigen::Index(i), Eigen::Index(j));
    }
    pose.dots = static_cast<int>(fit->used.size());
    pose.residual_px = fit->residual_px;
    if (fit->second)
        pose.second = SecondPose{camera_of(*fit->second, origin_mm), fit->second_odds_log2};
    return pose;
}

CameraInSpace on_sheet(const CameraInSpace& camera, const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    const auto along = [](double mm, double scaled_mm, std::uint32_t first, double origin_mm) {
        // The code plane is cyclic, so the difference is reduced to at most half a period.
        const double period_mm = scaled_mm * kPositionsPerAxis;
        return origin_mm + std::remainder(mm - scaled_mm * first, period_mm);
    };
    CameraInSpace result = camera;
    const double spacing_mm = sheet.pattern.spacing_mm;
    result.x_mm =
        along(camera.x_mm, spacing_mm * entry.print_scale_x, sheet.origin.x, sheet.origin_x_mm);
    result.y_mm =
        along(camera.y_mm, spacing_mm * entry.print_scale_y, sheet.origin.y, sheet.origin_y_mm);
    return result;
}

CameraInWorld in_world(const CameraInSpace& camera, const SpaceCovariance& covariance,
                       const WorldPose& page) {
    // In the frame of `camera`, z points into the paper. In the world frame, z points out of the
    // paper. A half turn about x converts between the two frames.
    const Quaterniond turn =
        Eigen::AngleAxisd(page.yaw_rad, Vector3d::UnitZ()) * Quaterniond(0, 1, 0, 0);
    const Vector3d position = turn * Vector3d(camera.x_mm, camera.y_mm, camera.z_mm) / 1000 +
                              Vector3d(page.x_m, page.y_m, 0);
    const Quaterniond rotation = turn * eigen_of(camera.rotation);
    Eigen::Matrix<double, 6, 6> by_pose = Eigen::Matrix<double, 6, 6>::Zero();
    by_pose.topLeftCorner<3, 3>() = turn.toRotationMatrix() / 1000;
    by_pose.bottomRightCorner<3, 3>() = rotation.toRotationMatrix();
    CameraInWorld world{position.x(), position.y(), position.z(), quaternion_of(rotation), {}};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
            for (std::size_t k = 0; k < 6; ++k) {
                for (std::size_t l = 0; l < 6; ++l) {
                    world.covariance[i][j] += by_pose(Eigen::Index(i), Eigen::Index(k)) *
                                              covariance[k][l] *
                                              by_pose(Eigen::Index(j), Eigen::Index(l));
                }
            }
        }
    }
    return world;
}

std::optional<CameraInWorld> certain_in_world(const std::optional<SpacePose>& pose,
                                              const std::optional<SheetPlace>& place) {
    if (!pose || pose->is_ambiguous() || !place || !place->entry->world) return std::nullopt;
    const SheetEntry& entry = *place->entry;
    return in_world(on_sheet(pose->camera, entry), pose->covariance, *entry.world);
}

}  // namespace dotpose

#include "space_view.hpp"

#include <cmath>
#include <cstdint>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace dotpose::tables {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Returns the information about the pose from one dot, at `place_mm` from the pose point, or 0 if
/// the dot is not completely in view.
SpaceMatrix information_of_dot(const Shot& shot, const Matrix3d& rotation,
                               const Vector3d& position_mm, const Vector2d& place_mm,
                               double jitter_mm, double centre_px) {
    const CameraModel& camera = shot.camera;
    const Vec2 pixel =
        Projection(camera, shot.pose).pixel_from_offset({place_mm.x(), place_mm.y()});
    const double radius_px = shot.page.pattern.dot_mm / 2 / camera.mm_per_px + 1;
    if (pixel.x < radius_px || pixel.y < radius_px || pixel.x > camera.width_px - 1 - radius_px ||
        pixel.y > camera.height_px - 1 - radius_px) {
        return SpaceMatrix::Zero();
    }
    const double focal_px = camera.working_distance_mm / camera.mm_per_px;
    const Vector3d seen =
        rotation.transpose() * (Vector3d(place_mm.x(), place_mm.y(), 0) - position_mm);
    Eigen::Matrix<double, 2, 3> by_seen;
    by_seen << 1, 0, -seen.x() / seen.z(), 0, 1, -seen.y() / seen.z();
    by_seen *= focal_px / seen.z();
    Eigen::Matrix<double, 2, 6> by_pose;
    by_pose.leftCols<3>() = -by_seen * rotation.transpose();
    for (int i = 0; i < 3; ++i)
        by_pose.col(3 + i) = by_seen * seen.cross(Vector3d::Unit(i));
    const Matrix2d by_place = by_pose.topLeftCorner<2, 2>();
    const Matrix2d covariance = jitter_mm * jitter_mm * by_place * by_place.transpose() +
                                centre_px * centre_px * Matrix2d::Identity();
    return by_pose.transpose() * covariance.inverse() * by_pose;
}

}  // namespace

TrueSpacePose true_space_pose(const Shot& shot) {
    const CameraPose& pose = shot.pose;
    const double spacing_mm = shot.page.pattern.spacing_mm;
    // The paper is tilted about the image y axis, and then about the image x axis. Theta is the
    // angle of the image x axis at the image centre, which is another direction on the paper if the
    // paper is tilted about both axes.
    const Matrix3d tilt = (Eigen::AngleAxisd(pose.tilt_x_rad, Vector3d::UnitX()) *
                           Eigen::AngleAxisd(pose.tilt_y_rad, Vector3d::UnitY()))
                              .toRotationMatrix();
    // Place on the tilted paper of a point one unit to the right of the image centre.
    const Vector3d normal = tilt.col(2);
    const Vector3d right(1, 0, -normal.x() / normal.z());
    const Vector3d on_paper = tilt.transpose() * right;
    const double turn_rad = pose.theta_rad - std::atan2(on_paper.y(), on_paper.x());
    const Matrix3d rotation =
        Eigen::AngleAxisd(turn_rad, Vector3d::UnitZ()).toRotationMatrix() * tilt.transpose();
    const Vector3d seen_mm(x_grid(pose) * spacing_mm, y_grid(pose) * spacing_mm, 0);
    return {seen_mm - rotation * Vector3d(0, 0, shot.camera.working_distance_mm), rotation};
}

Camera space_camera(const CameraModel& model) {
    Camera camera;
    camera.width_px = model.width_px;
    camera.height_px = model.height_px;
    camera.k_per_px2 = model.k;
    camera.centre_px = {(model.width_px - 1) / 2.0, (model.height_px - 1) / 2.0};
    camera.focal_px = model.working_distance_mm / model.mm_per_px;
    return camera;
}

SpaceVector space_error(const CameraInSpace& camera, const TrueSpacePose& truth) {
    const Quaternion& q = camera.rotation;
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(q.w, q.x, q.y, q.z).conjugate() *
                                 Eigen::Quaterniond(truth.rotation));
    SpaceVector error;
    error.head<3>() = truth.position_mm - Vector3d(camera.x_mm, camera.y_mm, camera.z_mm);
    error.tail<3>() = std::remainder(turn.angle(), 2 * std::numbers::pi) * turn.axis();
    return error;
}

SpaceMatrix space_bound(const Shot& shot, double jitter_mm, double centre_px) {
    const Pattern& pattern = shot.page.pattern;
    const TrueSpacePose truth = true_space_pose(shot);
    const Vector3d seen_mm(x_grid(shot.pose) * pattern.spacing_mm,
                           y_grid(shot.pose) * pattern.spacing_mm, 0);
    // The view of a strongly tilted camera extends to several times its width.
    const double reach_mm = 4 * shot.camera.width_px * shot.camera.mm_per_px;
    const auto reach = static_cast<int>(reach_mm / pattern.spacing_mm);
    SpaceMatrix information = SpaceMatrix::Zero();
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            const Place place = moved(pattern.code, {shot.pose.cell, pattern.section}, i, j);
            const Symbol symbol = symbol_at(pattern.code, place.cell, place.section);
            const Vector2d place_mm((i - shot.pose.fraction_x) * pattern.spacing_mm +
                                        dx(symbol) * pattern.displacement_mm,
                                    (j - shot.pose.fraction_y) * pattern.spacing_mm +
                                        dy(symbol) * pattern.displacement_mm);
            information += information_of_dot(shot, truth.rotation, truth.position_mm - seen_mm,
                                              place_mm, jitter_mm, centre_px);
        }
    }
    return information.ldlt().solve(SpaceMatrix::Identity());
}

}  // namespace dotpose::tables

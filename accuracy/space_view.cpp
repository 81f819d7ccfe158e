#include "space_view.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "calibrate/dots_in_view.hpp"
#include "space_opencv.hpp"
#include "table_run.hpp"

namespace dotpose::tables {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Returns true if a dot centred at this pixel is completely inside the image.
bool is_in_view(const Shot& shot, const Vec2& pixel) {
    const CameraModel& camera = shot.camera;
    const double radius_px = shot.page.pattern.dot_mm / 2 / camera.mm_per_px + 1;
    return pixel.x >= radius_px && pixel.y >= radius_px &&
           pixel.x <= camera.width_px - 1 - radius_px &&
           pixel.y <= camera.height_px - 1 - radius_px;
}

/// Returns the length in the image, in px, of one spacing at a point on the paper. In a tilted
/// view, this length depends on the direction of the spacing. Returns the minimum over all
/// directions.
double shortest_spacing_px(const Projection& projection, const Vec2& place_mm, double spacing_mm) {
    const auto step = [&](double x_mm, double y_mm) {
        const Vec2 to = projection.pixel_from_offset({place_mm.x + x_mm, place_mm.y + y_mm});
        const Vec2 from = projection.pixel_from_offset({place_mm.x - x_mm, place_mm.y - y_mm});
        return Vector2d((to.x - from.x) / 2, (to.y - from.y) / 2);
    };
    // Difference quotients over a tenth of a spacing approximate the derivatives.
    Matrix2d by_spacing;
    by_spacing << 10 * step(spacing_mm / 10, 0), 10 * step(0, spacing_mm / 10);
    return by_spacing.jacobiSvd().singularValues()[1];
}

/// Returns the derivatives of a dot's pixel position with respect to the pose. `place_mm` is the
/// position of the dot relative to the camera, along the axes of the pattern.
Eigen::Matrix<double, 2, 6> by_pose(const Matrix3d& rotation, const Vector3d& place_mm,
                                    double focal_px) {
    const Vector3d seen = rotation.transpose() * place_mm;
    Eigen::Matrix<double, 2, 3> by_seen;
    by_seen << 1, 0, -seen.x() / seen.z(), 0, 1, -seen.y() / seen.z();
    by_seen *= focal_px / seen.z();
    Eigen::Matrix<double, 2, 6> result;
    result.leftCols<3>() = -by_seen * rotation.transpose();
    for (int i = 0; i < 3; ++i)
        result.col(3 + i) = by_seen * seen.cross(Vector3d::Unit(i));
    return result;
}

/// Returns the Cramer-Rao bound on the covariance of a dot's image centre, given that blur,
/// contrast and paper level are known. Treats the image of the dot as a Gaussian.
Matrix2d centre_bound(const Shot& shot, const Matrix2d& by_place) {
    const Imperfections& noise = shot.imperfections;
    const double radius_mm = shot.page.pattern.dot_mm / 2;
    constexpr double kPixel_px2 = 1.0 / 12;
    const Matrix2d shape =
        radius_mm * radius_mm / 4 * by_place * by_place.transpose() +
        (noise.blur_sigma_px * noise.blur_sigma_px + kPixel_px2) * Matrix2d::Identity();
    const double area_px2 =
        std::numbers::pi * radius_mm * radius_mm * std::abs(by_place.determinant());
    const double root = std::sqrt(shape.determinant());
    const double peak =
        noise.paper_level * (1 - noise.ink_reflectance) * area_px2 / (2 * std::numbers::pi * root);
    // The Fisher information of the centre is peak^2 / variance * pi / 2 * root * shape^-1. The
    // bound is its inverse.
    const double rounding = 1.0 / 12;
    const double variance = noise.noise_sigma * noise.noise_sigma + rounding;
    return variance / (peak * peak * std::numbers::pi / 2 * root) * shape;
}

/// Returns options for a locator that records the trace required by `space_pose`.
DeviceOptions options_of(const Camera& camera) {
    DeviceOptions options;
    use_camera(camera, camera.width_px, camera.height_px, options);
    options.show_stages = true;
    return options;
}

}  // namespace

Shot space_shot(const SpaceLens& lens, double tilt_deg, std::uint64_t seed, std::uint64_t index) {
    Setup setup;
    setup.camera.width_px = 640;
    setup.camera.height_px = 480;
    setup.camera.k = lens.k;
    setup.camera.working_distance_mm = lens.distance_mm;
    setup.seed = seed;
    Shot shot = draw_shot(setup, index);
    Rng rng(shot.seed, 1);
    const double azimuth_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double tilt_rad = tilt_deg * std::numbers::pi / 180;
    // The normal of the paper is tilted in the direction `azimuth_rad`.
    shot.pose.tilt_y_rad = std::asin(std::sin(tilt_rad) * std::cos(azimuth_rad));
    shot.pose.tilt_x_rad =
        std::atan2(std::sin(tilt_rad) * std::sin(azimuth_rad), std::cos(tilt_rad));
    return shot;
}

TrueSpacePose true_space_pose(const Shot& shot) {
    const CameraPose& pose = shot.pose;
    const double spacing_mm = shot.page.pattern.spacing_mm;
    // The paper is tilted about the image y axis and then about the image x axis. Theta is the
    // angle of the image x axis on the paper, measured at the image centre. The tilts change this
    // angle, so the rotation about the normal of the paper is theta minus that change.
    const Matrix3d tilt = (Eigen::AngleAxisd(pose.tilt_x_rad, Vector3d::UnitX()) *
                           Eigen::AngleAxisd(pose.tilt_y_rad, Vector3d::UnitY()))
                              .toRotationMatrix();
    // The point on the tilted paper that appears one unit to the right of the image centre.
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

SpaceMatrix matrix_of(const SpaceCovariance& covariance) {
    SpaceMatrix result;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            result(Eigen::Index(i), Eigen::Index(j)) = covariance[i][j];
    }
    return result;
}

double normalised_square(const SpaceVector& error, const SpaceMatrix& covariance) {
    return error.dot(covariance.ldlt().solve(error));
}

SpaceReading::SpaceReading(const Shot& shot)
    : camera_(space_camera(shot.camera)),
      image_(render(shot)),
      locator_(thread_memory(), options_of(camera_)),
      fix_(locator_.locate(image_.view())),
      pose_(space_pose(fix_, camera_, image_.view(), locator_.trace())) {}

#ifdef DOTPOSE_HAS_CALIB3D
CameraInSpace SpaceReading::opencv_pose() const {
    const double mm = fix_.spacing_mm();
    const Trace trace = locator_.trace();
    const auto fit =
        calibrate::fit_to_image(image_.view(), {camera_, *pinhole_of(camera_), {mm, mm}}, trace);
    const calibrate::SpaceState state = tables::opencv_pose(fit.value(), *camera_.focal_px);
    const Eigen::Quaterniond rotation(state.rotation);
    const Cell start = trace.decoding.place.cell;
    return {state.position_mm.x() + mm * start.x,
            state.position_mm.y() + mm * start.y,
            state.position_mm.z(),
            {rotation.w(), rotation.x(), rotation.y(), rotation.z()}};
}
#endif

SpaceMatrix space_bound(const Shot& shot, double jitter_mm) {
    const Pattern& pattern = shot.page.pattern;
    const TrueSpacePose truth = true_space_pose(shot);
    const Projection projection(shot.camera, shot.pose);
    const double focal_px = shot.camera.working_distance_mm / shot.camera.mm_per_px;
    const double mm = pattern.spacing_mm;
    const Vector3d from_camera =
        Vector3d(x_grid(shot.pose) * mm, y_grid(shot.pose) * mm, 0) - truth.position_mm;
    // A tilted camera also sees dots outside the area that is visible without tilt. The search
    // therefore extends three times the width of that area in each direction.
    const auto reach = static_cast<int>(3 * shot.camera.width_px * shot.camera.mm_per_px / mm);
    SpaceMatrix information = SpaceMatrix::Zero();
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            const Vec2 near_mm{(i - shot.pose.fraction_x) * mm, (j - shot.pose.fraction_y) * mm};
            if (!is_in_view(shot, projection.pixel_from_offset(near_mm))) continue;
            const Place place = moved(pattern.code, {shot.pose.cell, pattern.section}, i, j);
            const Symbol symbol = symbol_at(pattern.code, place.cell, place.section);
            const Vec2 place_mm{near_mm.x + dx(symbol) * pattern.displacement_mm,
                                near_mm.y + dy(symbol) * pattern.displacement_mm};
            if (!is_in_view(shot, projection.pixel_from_offset(place_mm)) ||
                shortest_spacing_px(projection, place_mm, mm) < kResolvedSpacing_px)
                continue;
            const Eigen::Matrix<double, 2, 6> rows = by_pose(
                truth.rotation, Vector3d(place_mm.x, place_mm.y, 0) + from_camera, focal_px);
            const Matrix2d by_place = -rows.topLeftCorner<2, 2>();
            const Matrix2d covariance = jitter_mm * jitter_mm * by_place * by_place.transpose() +
                                        centre_bound(shot, by_place);
            information += rows.transpose() * covariance.inverse() * rows;
        }
    }
    return information.ldlt().solve(SpaceMatrix::Identity());
}

}  // namespace dotpose::tables

#include "calibrate/plane_start.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "calibrate/least_squares.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Viewing direction towards one point on the paper, and the derivative of this direction with
/// respect to the position of the point.
struct LocalView {
    Vector2d place_mm;
    Vector2d ray;  ///< (x, y) of the direction (x, y, 1) in the camera frame
    Matrix2d per_mm;
};

/// Fits a homography from the paper to the viewing directions. Returns its value and its derivative
/// at the middle of the dots.
LocalView local_view(const std::vector<SpaceDot>& dots, const Vector2d& focal_px) {
    const double displacement = SpaceState().displacement;
    Vector2d middle = Vector2d::Zero();
    for (const SpaceDot& dot : dots)
        middle += dot.intersection_mm / static_cast<double>(dots.size());
    double reach_mm = 0;
    for (const SpaceDot& dot : dots)
        reach_mm = std::max(reach_mm, (dot.intersection_mm - middle).norm());
    NormalEquations equations(8);
    for (const SpaceDot& dot : dots) {
        const Vector2d at =
            (dot.intersection_mm + displacement * dot.direction_mm - middle) / reach_mm;
        const Vector2d ray = dot.pixel.cwiseQuotient(focal_px);
        const double x = at.x();
        const double y = at.y();
        equations.add(std::array{x, y, 1.0, 0.0, 0.0, 0.0, -ray.x() * x, -ray.x() * y}, ray.x());
        equations.add(std::array{0.0, 0.0, 0.0, x, y, 1.0, -ray.y() * x, -ray.y() * y}, ray.y());
    }
    const std::vector<double> h = equations.solution();
    LocalView view;
    view.place_mm = middle;
    view.ray = {h[2], h[5]};
    view.per_mm << h[0] - h[2] * h[6], h[1] - h[2] * h[7], h[3] - h[5] * h[6], h[4] - h[5] * h[7];
    view.per_mm /= reach_mm;
    return view;
}

}  // namespace

std::optional<std::array<SpaceState, 2>> plane_starts(const std::vector<SpaceDot>& dots,
                                                      const Vector2d& focal_px) {
    const LocalView view = local_view(dots, focal_px);
    if (!view.per_mm.allFinite() || !view.ray.allFinite()) return std::nullopt;
    // Rotates the camera towards the middle of the dots. `local` is the derivative of the viewing
    // direction in the frame of the rotated camera. It equals the upper left 2 x 2 block of the
    // paper's rotation matrix, divided by the distance.
    const Matrix3d turn =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), view.ray.homogeneous())
            .toRotationMatrix();
    Eigen::Matrix<double, 2, 3> project;
    project << 1, 0, -view.ray.x(), 0, 1, -view.ray.y();
    const Matrix2d local = (project * turn).leftCols<2>().inverse() * view.per_mm;
    // The larger singular value is 1 / distance, where the distance is along the optical axis.
    const Matrix2d squares = local.transpose() * local;
    const double mean = squares.trace() / 2;
    const double root = std::sqrt(std::max(mean * mean - squares.determinant(), 0.0));
    const double per_mm = std::sqrt(mean + root);
    if (!(per_mm > 0) || !(local.determinant() > 0)) return std::nullopt;
    const Matrix2d upper = local / per_mm;
    // The columns of a rotation matrix have length 1 and are perpendicular.
    const double z_x = std::sqrt(std::max(1 - upper.col(0).squaredNorm(), 0.0));
    const double z_y = std::copysign(std::sqrt(std::max(1 - upper.col(1).squaredNorm(), 0.0)),
                                     -upper.col(0).dot(upper.col(1)));
    std::array<SpaceState, 2> states;
    for (std::size_t i = 0; i < 2; ++i) {
        const double sign = i == 0 ? 1 : -1;
        Matrix3d camera_from_paper;
        camera_from_paper.col(0) << upper.col(0), sign * z_x;
        camera_from_paper.col(1) << upper.col(1), sign * z_y;
        camera_from_paper.col(2) = camera_from_paper.col(0).cross(camera_from_paper.col(1));
        camera_from_paper = turn * Eigen::Quaterniond(camera_from_paper).normalized();
        states[i].rotation = camera_from_paper.transpose();
        const Vector3d middle(view.place_mm.x(), view.place_mm.y(), 0);
        states[i].position_mm = middle - states[i].rotation * (view.ray.homogeneous() / per_mm);
    }
    return states;
}

}  // namespace dotpose::calibrate

#include "calibration_bound.hpp"

#include <cmath>
#include <functional>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace dotpose::tables {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;

Vec2 displacement_mm(const Page& page, Cell cell) {
    const Symbol symbol = symbol_at(page.pattern.code, cell, page.pattern.section);
    return {dx(symbol) * page.pattern.displacement_mm, dy(symbol) * page.pattern.displacement_mm};
}

/// Returns the printed dot nearest to the point at `offset_mm` from the pose point.
TrueDot nearest_dot(const Shot& shot, Vec2 offset_mm) {
    const double mm = shot.page.pattern.spacing_mm;
    const CameraPose& pose = shot.pose;
    const auto i = std::llround(offset_mm.x / mm + pose.fraction_x);
    const auto j = std::llround(offset_mm.y / mm + pose.fraction_y);
    TrueDot best;
    best.off_mm = {HUGE_VAL, HUGE_VAL};
    for (std::int64_t y = j - 1; y <= j + 1; ++y) {
        for (std::int64_t x = i - 1; x <= i + 1; ++x) {
            const Cell cell{static_cast<std::uint32_t>(pose.cell.x + x),
                            static_cast<std::uint32_t>(pose.cell.y + y)};
            const Vec2 displaced = displacement_mm(shot.page, cell);
            const Vec2 off{
                offset_mm.x - (static_cast<double>(x) - pose.fraction_x) * mm - displaced.x,
                offset_mm.y - (static_cast<double>(y) - pose.fraction_y) * mm - displaced.y};
            if (std::hypot(off.x, off.y) >= std::hypot(best.off_mm.x, best.off_mm.y)) continue;
            best.off_mm = off;
            best.displaced_mm = displaced;
        }
    }
    return best;
}

/// An unknown parameter of a camera: its name, the step for its numerical derivative, and a
/// function that adds a value to the parameter.
struct Parameter {
    const char* name;
    double step;
    std::function<void(Camera& camera, double by)> add;
};

std::vector<Parameter> parameters_of(Unknown unknown) {
    std::vector<Parameter> all = {
        {"k_per_px2", 1e-9, [](Camera& c, double by) { c.k_per_px2 += by; }},
        {"centre_u_px", 1e-3, [](Camera& c, double by) { c.centre_px.u += by; }},
        {"centre_v_px", 1e-3, [](Camera& c, double by) { c.centre_px.v += by; }},
        {"mm_per_px_x", 1e-6, [](Camera& c, double by) { c.paper->mm_per_px_x += by; }}};
    if (unknown != Unknown::view) {
        all.back().add = [](Camera& c, double by) {
            c.paper->mm_per_px_x += by;
            c.paper->mm_per_px_y += by;
        };
    }
    if (unknown == Unknown::straight) return all;
    all.push_back(
        {"perspective_u_per_px", 1e-7, [](Camera& c, double by) { c.paper->perspective_u += by; }});
    all.push_back(
        {"perspective_v_per_px", 1e-7, [](Camera& c, double by) { c.paper->perspective_v += by; }});
    if (unknown == Unknown::square) return all;
    all.push_back({"mm_per_px_y", 1e-6, [](Camera& c, double by) { c.paper->mm_per_px_y += by; }});
    all.push_back({"skew", 1e-4, [](Camera& c, double by) { c.paper->skew += by; }});
    return all;
}

Vector2d on_paper_at(const Camera& camera, PixelPoint pixel) {
    const CameraPoint point = on_paper(camera, undistorted(camera, pixel));
    return {point.x_mm, point.y_mm};
}

/// Returns the Jacobian of a dot's position on the paper. The column of a parameter contains the
/// change in the position if the parameter changes by one step. The last column is the derivative
/// with respect to the length of the dots' displacement, relative to its nominal value. This length
/// is also unknown, because it depends on ink and blur.
MatrixXd jacobian(const Camera& camera, const TrueDot& dot,
                  const std::vector<Parameter>& parameters) {
    MatrixXd rows(2, static_cast<Eigen::Index>(parameters.size()) + 1);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        Camera more = camera;
        Camera less = camera;
        parameters[i].add(more, parameters[i].step / 2);
        parameters[i].add(less, -parameters[i].step / 2);
        rows.col(static_cast<Eigen::Index>(i)) =
            on_paper_at(more, dot.pixel) - on_paper_at(less, dot.pixel);
    }
    rows.rightCols<1>() = Vector2d(dot.displaced_mm.x, dot.displaced_mm.y);
    return rows;
}

}  // namespace

std::vector<TrueDot> true_dots(const LensCalibration& found, const std::vector<Shot>& shots) {
    std::vector<TrueDot> dots;
    for (const CalibrationDot& seen : found.seen) {
        const Shot& shot = shots.at(static_cast<std::size_t>(seen.frame));
        const Projection projection(shot.camera, shot.pose);
        TrueDot dot = nearest_dot(shot, projection.offset_from_pixel({seen.pixel.u, seen.pixel.v}));
        dot.frame = seen.frame;
        dot.pixel = seen.pixel;
        const double c = std::cos(shot.pose.theta_rad);
        const double s = std::sin(shot.pose.theta_rad);
        const Vec2 displaced = dot.displaced_mm;
        dot.displaced_mm = {c * displaced.x + s * displaced.y, c * displaced.y - s * displaced.x};
        dots.push_back(dot);
    }
    return dots;
}

std::map<std::string, double> min_sigmas(const Camera& camera, const std::vector<TrueDot>& dots,
                                         double jitter_mm, Unknown unknown) {
    const std::vector<Parameter> parameters = parameters_of(unknown);
    const auto count = static_cast<Eigen::Index>(parameters.size()) + 1;
    struct FrameSums {
        Eigen::Matrix3Xd with_camera;
        Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
    };
    MatrixXd information = MatrixXd::Zero(count, count);
    std::map<int, FrameSums> frames;
    for (const TrueDot& dot : dots) {
        const MatrixXd rows = jacobian(camera, dot, parameters);
        const Vector2d at = on_paper_at(camera, dot.pixel);
        // Derivatives of the dot's position with respect to the position and the angle of the
        // frame.
        Eigen::Matrix<double, 2, 3> pose;
        pose << 1, 0, -at.y(), 0, 1, at.x();
        FrameSums& frame = frames[dot.frame];
        if (frame.with_camera.cols() == 0) frame.with_camera.setZero(3, count);
        frame.with_camera += pose.transpose() * rows;
        frame.own += pose.transpose() * pose;
        information += rows.transpose() * rows;
    }
    for (const auto& [index, frame] : frames)
        information -= frame.with_camera.transpose() * frame.own.ldlt().solve(frame.with_camera);
    const MatrixXd covariance =
        jitter_mm * jitter_mm * information.ldlt().solve(MatrixXd::Identity(count, count));
    std::map<std::string, double> sigmas;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto index = static_cast<Eigen::Index>(i);
        sigmas[parameters[i].name] = parameters[i].step * std::sqrt(covariance(index, index));
    }
    return sigmas;
}

}  // namespace dotpose::tables

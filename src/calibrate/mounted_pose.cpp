// The pose of a camera whose view of the paper is known: place, angle and scale, by least squares.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "calibrate/sighting.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;

constexpr int kRounds = 3;
constexpr double kOutlier_sigmas = 4;
constexpr std::size_t kLeastDots = 12;

/// A dot in the camera frame, mm from `middle`; and where the code has it, in spacings.
struct Match {
    double x, y;
    double nominal_x, nominal_y;      ///< its intersection
    double displaced_x, displaced_y;  ///< per unit of displacement
};

/// nominal + displacement * displaced = place + (c, -s; s, c) (x, y); parameters: place, c, s,
/// displacement, which ink and blur change.
using Parameters = Eigen::Matrix<double, 5, 1>;

struct PoseFit {
    CameraPoint middle;
    Parameters parameters = Parameters::Zero();
    double spread = 0;  ///< sum of x^2 + y^2
    double variance = 0;
    int dots = 0;
};

std::array<double, 2> residual(const Match& m, const Parameters& p) {
    return {p[0] + p[2] * m.x - p[3] * m.y - p[4] * m.displaced_x - m.nominal_x,
            p[1] + p[3] * m.x + p[2] * m.y - p[4] * m.displaced_y - m.nominal_y};
}

std::vector<Match> matches_of(const Workspace& workspace, const Camera& camera, Profile profile,
                              CameraPoint& middle) {
    std::vector<Match> matches;
    middle = {};
    for (const SightedDot& dot : dots_read(workspace, profile)) {
        const CameraPoint point = on_paper(camera, dot.pixel);
        matches.push_back({point.x_mm, point.y_mm, double(dot.step.x), double(dot.step.y),
                           double(dx(dot.symbol)), double(dy(dot.symbol))});
        middle.x_mm += point.x_mm;
        middle.y_mm += point.y_mm;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(matches.size(), 1));
    middle = {middle.x_mm / count, middle.y_mm / count};
    for (Match& match : matches) {
        match.x -= middle.x_mm;
        match.y -= middle.y_mm;
    }
    return matches;
}

/// One fit to the dots within `limit` (squared, spacings) of the last one.
void fit_once(const std::vector<Match>& matches, double limit, PoseFit& fit) {
    Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
    Parameters right = Parameters::Zero();
    std::vector<const Match*> used;
    for (const Match& m : matches) {
        const auto [du, dv] = residual(m, fit.parameters);
        if (du * du + dv * dv > limit) continue;
        used.push_back(&m);
        const Parameters along_x{1, 0, m.x, -m.y, -m.displaced_x};
        const Parameters along_y{0, 1, m.y, m.x, -m.displaced_y};
        normal += along_x * along_x.transpose() + along_y * along_y.transpose();
        right += along_x * m.nominal_x + along_y * m.nominal_y;
    }
    fit.parameters = normal.ldlt().solve(right);
    fit.dots = static_cast<int>(used.size());
    fit.spread = 0;
    double squares = 0;
    for (const Match* m : used) {
        const auto [du, dv] = residual(*m, fit.parameters);
        squares += du * du + dv * dv;
        fit.spread += m->x * m->x + m->y * m->y;
    }
    fit.variance = squares / std::max(2 * fit.dots - 5, 1);
}

PoseFit fit_pose(const std::vector<Match>& matches, CameraPoint middle) {
    PoseFit fit;
    fit.middle = middle;
    double limit = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
        fit_once(matches, limit, fit);
        std::vector<double> squares;
        for (const Match& match : matches) {
            const auto [du, dv] = residual(match, fit.parameters);
            squares.push_back(du * du + dv * dv);
        }
        const auto median = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
        std::ranges::nth_element(squares, median);
        // Squared distances of a plane Gaussian have their median at 1.39 sigma^2.
        limit = kOutlier_sigmas * kOutlier_sigmas * *median / 1.386;
    }
    return fit;
}

/// The direction, in the camera frame, of the image x axis at an undistorted pixel.
double image_axis_rad(const Camera& camera, PixelPoint pixel) {
    const CameraPoint from = on_paper(camera, {pixel.u - 0.5, pixel.v});
    const CameraPoint to = on_paper(camera, {pixel.u + 0.5, pixel.v});
    return std::atan2(to.y_mm - from.y_mm, to.x_mm - from.x_mm);
}

std::uint32_t to_bam(double angle_rad) {
    constexpr double kBam_per_rad = 2147483648.0 / std::numbers::pi;
    return static_cast<std::uint32_t>(std::llround(angle_rad * kBam_per_rad));
}

/// Writes x and y, in spacings from `place`, as cell and fraction.
void write_place(double x, double y, Profile profile, const Place& place, Fix& fix) {
    const auto x_q16 = std::llround(x * 65536);
    const auto y_q16 = std::llround(y * 65536);
    const Place cell = moved(profile, place, static_cast<std::int32_t>(x_q16 >> 16),
                             static_cast<std::int32_t>(y_q16 >> 16));
    fix.cell = cell.cell;
    fix.section = cell.section;
    fix.fraction_x_q16 = static_cast<std::uint16_t>(x_q16 & 65535);
    fix.fraction_y_q16 = static_cast<std::uint16_t>(y_q16 & 65535);
}

void write_covariance(const PoseFit& fit, double lever_x, double lever_y, Fix& out) {
    // The place of `middle` and the turn and scale about it are independent of each other.
    const double at_middle = fit.variance / fit.dots;
    const double per_lever = fit.variance / fit.spread;
    const double size = std::hypot(fit.parameters[2], fit.parameters[3]);
    const double lever2 = lever_x * lever_x + lever_y * lever_y;
    const auto set = [&out](int i, int j, double value) {
        out.covariance[i][j] = out.covariance[j][i] = static_cast<float>(value);
    };
    // The lever as it lies on the pattern.
    const double x = fit.parameters[2] * lever_x - fit.parameters[3] * lever_y;
    const double y = fit.parameters[3] * lever_x + fit.parameters[2] * lever_y;
    const double turn = per_lever / (size * size);
    set(0, 0, at_middle + per_lever * lever2);
    set(1, 1, at_middle + per_lever * lever2);
    set(0, 1, 0);
    set(0, 2, -y * turn);
    set(1, 2, x * turn);
    set(2, 2, turn);
}

}  // namespace

Fix with_camera(const Fix& fix, const Camera& camera, const Options& options,
                const Workspace& workspace) {
    if (fix.status != Status::ok) return fix;
    Fix result = fix;
    double theta_rad = fix.theta_rad();
    if (camera.paper) {
        CameraPoint middle;
        const auto matches = matches_of(workspace, camera, options.profile, middle);
        if (matches.size() >= kLeastDots) {
            const PoseFit pose = fit_pose(matches, middle);
            const PixelPoint reference{
                (camera.width_px - 1) / 2.0 + options.reference_dx_q8 / 256.0,
                (camera.height_px - 1) / 2.0 + options.reference_dy_q8 / 256.0};
            const CameraPoint at = on_paper(camera, reference);
            const double x = at.x_mm - middle.x_mm;
            const double y = at.y_mm - middle.y_mm;
            const Parameters& p = pose.parameters;
            write_place(p[0] + p[2] * x - p[3] * y, p[1] + p[3] * x + p[2] * y, options.profile,
                        workspace.decoding.place, result);
            write_covariance(pose, x, y, result);
            result.dots_used = pose.dots;
            result.residual_px = static_cast<float>(std::sqrt(pose.variance) * fix.spacing_px());
            theta_rad = std::atan2(p[3], p[2]) + image_axis_rad(camera, reference);
        }
    }
    result.theta_bam = static_cast<std::int32_t>(to_bam(theta_rad + camera.theta_offset_rad));
    return result;
}

}  // namespace dotpose

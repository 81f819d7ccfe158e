#include "calibrate/print_view.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

/// A hand holds a camera straight to a degree or so, by which lengths change by 1 % across its
/// view; scanners bend a page by less than a tenth of that.
constexpr double kLeastSign = 0.003;
/// And a camera explains so much of what a flat page leaves open. The carriage of a scanner that
/// runs unevenly moves dots along one axis only.
constexpr double kLargestResidual = 0.8;

/// The plane that a camera of one focal length and principal point sees.
struct Plane {
    double x_over_y = 1;   ///< lengths along the two axes of the paper
    double cos_angle = 0;  ///< between them
};

/// With lengths in focal lengths, the homography's columns are the axes of the paper, turned and
/// scaled; `principal`: where the camera looks, px from the middle of the image.
Plane plane_seen(const PlaneFit& fit, double focal_px, const Vector2d& principal) {
    const Vector2d& p = fit.perspective_per_mm;
    const Vector2d offset = fit.offset - principal;
    const auto axis = [&](int i) {
        const Vector2d across = (fit.linear.col(i) + offset * p[i]) / focal_px;
        return Eigen::Vector3d(across.x(), across.y(), p[i]);
    };
    const Eigen::Vector3d x = axis(0);
    const Eigen::Vector3d y = axis(1);
    return {x.norm() / y.norm(), x.dot(y) / (x.norm() * y.norm())};
}

}  // namespace

std::optional<ScaleRatio> scale_ratio_of(const PlaneFit& fit, double longer_side_px) {
    // From wide angles to short telephoto lenses, such as phones have.
    constexpr double kShortestFocal = 0.5;
    constexpr double kLongestFocal = 2;
    constexpr double kFocalStep = 1.02;
    // How far off the middle cameras look, and how far from right angles printers are.
    constexpr double kPrincipalShift = 0.01;
    constexpr double kLargestCos = 0.002;
    constexpr double kLargestUncertainty = 0.005;
    double least = 1e9;
    double most = -1e9;
    for (double focal = kShortestFocal; focal < kLongestFocal; focal *= kFocalStep) {
        for (const Vector2d& shift :
             {Vector2d(0, 0), Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0, 1), Vector2d(0, -1)}) {
            const Plane plane =
                plane_seen(fit, focal * longer_side_px, kPrincipalShift * longer_side_px * shift);
            if (std::abs(plane.cos_angle) > kLargestCos) continue;
            least = std::min(least, plane.x_over_y);
            most = std::max(most, plane.x_over_y);
        }
    }
    if (least > most || most - least > 2 * kLargestUncertainty) return std::nullopt;
    // Lenses have more terms than the one that is fitted.
    constexpr double kLensUncertainty = 0.0005;
    return ScaleRatio{0.5 * (least + most), 0.5 * (most - least) + kLensUncertainty};
}

std::optional<CameraSigns> signs_of_camera(const std::vector<Match>& matches,
                                           const Vector2d& middle_px) {
    const PlaneFit flat = fit_plane(matches, ViewModel::flat);
    const PlaneFit camera = fit_plane(matches, ViewModel::camera, middle_px);
    Vector2d low = matches.front().nominal_mm;
    Vector2d high = low;
    double farthest_px2 = 0;
    for (const Match& match : matches) {
        low = low.cwiseMin(match.nominal_mm);
        high = high.cwiseMax(match.nominal_mm);
        farthest_px2 = std::max(farthest_px2, (match.seen - middle_px).squaredNorm());
    }
    CameraSigns signs;
    signs.perspective = camera.perspective_per_mm.cwiseAbs().dot(high - low);
    signs.lens = camera.lens * farthest_px2;
    const bool is_notable = std::max(signs.perspective, std::abs(signs.lens)) > kLeastSign;
    if (is_notable && camera.residual < kLargestResidual * flat.residual) return signs;
    return std::nullopt;
}

}  // namespace dotpose::calibrate

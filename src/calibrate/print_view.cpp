#include "calibrate/print_view.hpp"

#include <algorithm>

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

/// A hand holds a camera straight to a degree or so, by which lengths change by 1 % across its
/// view; scanners bend a page by less than a tenth of that.
constexpr double kLeastSign = 0.003;
/// And a camera explains so much of what a flat page leaves open. The carriage of a scanner that
/// runs unevenly moves dots along one axis only.
constexpr double kLargestResidual = 0.8;

}  // namespace

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

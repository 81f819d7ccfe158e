#include "calibrate/print_view.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::calibrate {
namespace {

using Eigen::Vector2d;

/// An image is considered a photo only if perspective or lens distortion changes lengths by more
/// than this fraction. Scanners change lengths by less than 0.1 %. A hand-held camera that is meant
/// to be perpendicular to the paper is tilted by about a degree, which changes lengths by 1 %.
constexpr double kMinSign = 0.003;
/// An image is considered a photo only if the residual of a fit with perspective and lens
/// distortion is less than this fraction of the residual of a fit without them. Uneven motion of a
/// scanner's carriage displaces dots along one axis only, so perspective and lens distortion hardly
/// reduce the residual of a scan.
constexpr double kMaxResidual = 0.8;

/// Plane of the paper as seen by a camera with a given focal length and principal point.
struct Plane {
    double x_over_y = 1;   ///< scale along the x axis divided by the scale along the y axis
    double cos_angle = 0;  ///< cosine of the angle between the axes
};

/// Returns the plane of the paper. `principal` is the principal point in px from the middle of the
/// image. If lengths are in units of the focal length, the columns of the homography are the axes
/// of the paper, rotated and scaled.
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
    // Range of focal lengths, in units of the longer image side: from wide-angle lenses to the
    // short telephoto lenses of phones.
    constexpr double kMinFocal = 0.5;
    constexpr double kMaxFocal = 2;
    constexpr double kFocalStep = 1.02;
    // Maximum distance of the principal point from the middle, in units of the longer image side,
    // and maximum cosine of the angle between the printed axes.
    constexpr double kPrincipalShift = 0.01;
    constexpr double kMaxCos = 0.002;
    constexpr double kMaxUncertainty = 0.005;
    double least = 1e9;
    double most = -1e9;
    for (double focal = kMinFocal; focal < kMaxFocal; focal *= kFocalStep) {
        for (const Vector2d& shift :
             {Vector2d(0, 0), Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0, 1), Vector2d(0, -1)}) {
            const Plane plane =
                plane_seen(fit, focal * longer_side_px, kPrincipalShift * longer_side_px * shift);
            if (std::abs(plane.cos_angle) > kMaxCos) continue;
            least = std::min(least, plane.x_over_y);
            most = std::max(most, plane.x_over_y);
        }
    }
    if (least > most || most - least > 2 * kMaxUncertainty) return std::nullopt;
    // Uncertainty due to the lens. The fit has only one distortion term, whereas real lenses have
    // more.
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
    const bool is_notable = std::max(signs.perspective, std::abs(signs.lens)) > kMinSign;
    if (is_notable && camera.residual < kMaxResidual * flat.residual) return signs;
    return std::nullopt;
}

}  // namespace dotpose::calibrate

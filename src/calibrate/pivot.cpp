// Finds the tip of a pen from frames in which the pen pivots about its tip.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <fmt/core.h>

#include "calibrate/dots_in_view.hpp"
#include "calibrate/pivot_fit.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/files/degrees.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/space_pose.hpp"

namespace dotpose {
namespace {

using calibrate::PivotFit;
using calibrate::PivotView;

constexpr int kMinPivotFrames = 6;
/// Minimum pivot angle. At smaller angles, the error of the tip is more than about 10 times the
/// error of the pose.
constexpr double kMinPivot_rad = 3 / kDegrees;
constexpr double kMinUsed = 2.0 / 3;

/// Poses of all frames that have a pose in space.
struct PivotViews {
    std::vector<PivotView> views;
    double spacing_mm = 0;  ///< spacing of the sheet in the last of these frames
};

/// Returns the printed spacing of the sheet that contains a fix, or an empty optional if no sheet
/// contains it. If no sheets are given, returns the spacing in the options.
std::optional<AxisScale> spacing_of(const CalibrateOptions& options, CodeVariant code,
                                    const Fix& fix) {
    const double mm = options.pattern.spacing_mm;
    if (options.sheets.empty()) return AxisScale{mm, mm};
    const auto place = find_sheet(options.sheets, code, fix);
    if (!place) return std::nullopt;
    const double sheet_mm = place->entry->sheet.pattern.spacing_mm;
    return AxisScale{sheet_mm * place->entry->print_scale_x,
                     sheet_mm * place->entry->print_scale_y};
}

/// Returns the pose of the camera in the pattern frame, or an empty optional if there is no pose or
/// if the pose is ambiguous.
std::optional<PivotView> view_of(const GreyImage& image, const Camera& camera, const Trace& trace,
                                 const AxisScale& spacing_mm) {
    const auto fit =
        calibrate::fit_to_image(image.view(), {camera, *pinhole_of(camera), spacing_mm}, trace);
    if (!fit || (fit->second && fit->second_odds_log2 > SpacePose::kMaxOdds_log2))
        return std::nullopt;
    const Cell start = trace.decoding.place.cell;
    PivotView view;
    view.rotation = fit->state.rotation;
    view.position_mm =
        fit->state.position_mm + Eigen::Vector3d(spacing_mm.x * start.x, spacing_mm.y * start.y, 0);
    view.covariance = fit->covariance;
    for (std::size_t i = 0; i < fit->used.size(); ++i) {
        const Eigen::Vector2d& place_mm = fit->used[i].intersection_mm;
        const auto x = start.x + std::llround(place_mm.x() / spacing_mm.x);
        const auto y = start.y + std::llround(place_mm.y() / spacing_mm.y);
        view.influences.push_back(
            {(static_cast<std::uint64_t>(x) << 32U) ^ static_cast<std::uint64_t>(y),
             fit->influences[i]});
    }
    return view;
}

PivotViews locate_views(int frames, const FrameAt& frame_at, const Camera& camera,
                        const CalibrateOptions& options) {
    PivotViews result;
    Locator locator{DeviceOptions{}};
    CodeReader reader(given_code(options));
    for (int i = 0; i < frames; ++i) {
        const GreyImage image = frame_at(i);
        DeviceOptions how;
        use_camera(camera, image.width_px, image.height_px, how);
        how.show_stages = true;
        locator.set_options(how);
        const Fix fix = reader.locate(image.view(), locator);
        if (options.progress && !options.progress(i + 1, frames))
            throw Error("stopped; nothing was written");
        if (fix.status != Status::ok) continue;
        const auto spacing_mm = spacing_of(options, reader.code(), fix);
        if (!spacing_mm) continue;
        const auto view = view_of(image, camera, locator.trace(), *spacing_mm);
        if (!view) continue;
        result.views.push_back(*view);
        result.spacing_mm = spacing_mm->x;
    }
    return result;
}

double tilt_rad(const PivotView& view) {
    return std::acos(std::clamp(view.rotation(2, 2), -1.0, 1.0));
}

void require_pivot(double pivot_rad) {
    if (pivot_rad >= kMinPivot_rad) return;
    throw Error(
        fmt::format("the pen does not pivot enough: its rotations about one axis are {:.1f} "
                    "degrees (rms), and {:.0f} are needed; keep the tip at one point of the sheet, "
                    "and tilt the pen by up to 40 degrees to all sides",
                    pivot_rad * kDegrees, kMinPivot_rad * kDegrees));
}

/// Throws Error if the tip was not at rest.
void require_rest(const PivotCalibration& pivot, double spacing_mm) {
    if (pivot.used < kMinUsed * pivot.located) {
        throw Error(
            fmt::format("the tip moved: it is at one point in only {} of {} frames; keep it at "
                        "one point of the sheet, for example in a small dent",
                        pivot.used, pivot.located));
    }
    if (pivot.residual_mm <= spacing_mm / 2) return;
    throw Error(
        fmt::format("the tip moved by {:.3f} mm (rms per axis), and at most half a spacing, {:.3f} "
                    "mm, is permitted; keep it at one point of the sheet, for example in a small "
                    "dent",
                    pivot.residual_mm, spacing_mm / 2));
}

void require_accuracy(const PivotFit& fit, double spacing_mm) {
    const double sigma_mm = std::sqrt(fit.covariance.diagonal().head<3>().maxCoeff());
    if (sigma_mm <= spacing_mm / 2) return;
    throw Error(
        fmt::format("the frames do not determine the tip: it is known to +- {:.3f} mm, and half a "
                    "spacing, {:.3f} mm, is needed; tilt the pen farther to all sides, and take "
                    "more frames",
                    sigma_mm, spacing_mm / 2));
}

/// Returns the views that the fit used.
std::vector<PivotView> used_views(const std::vector<PivotView>& views, const PivotFit& fit) {
    std::vector<PivotView> used;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (fit.is_used[i]) used.push_back(views[i]);
    }
    return used;
}

void set_tip(const PivotFit& fit, Camera& camera) {
    camera.tip = PenTip{fit.tip_mm.x(), fit.tip_mm.y(), fit.tip_mm.z(), -fit.rest_mm.z()};
    const Eigen::VectorXd sigma = fit.covariance.diagonal().cwiseSqrt();
    camera.sigma["tip_x_mm"] = sigma[0];
    camera.sigma["tip_y_mm"] = sigma[1];
    camera.sigma["tip_z_mm"] = sigma[2];
    camera.sigma["tip_rest_mm"] = sigma[5];
}

}  // namespace

PivotCalibration calibrate_pivot(int frames, const FrameAt& frame_at, const Camera& camera,
                                 const CalibrateOptions& options) {
    require_focal_length(camera);
    const PivotViews found = locate_views(frames, frame_at, camera, options);
    const std::vector<PivotView>& views = found.views;
    PivotCalibration result;
    result.frames = frames;
    result.located = static_cast<int>(views.size());
    if (result.located < kMinPivotFrames) {
        throw Error(
            fmt::format("only {} of {} frames have a pose in space; at least {} are needed, "
                        "preferably 30",
                        result.located, frames, kMinPivotFrames));
    }
    require_pivot(calibrate::pivot_angle_rad(views));
    const PivotFit fit = calibrate::fit_pivot(views);
    const std::vector<PivotView> used = used_views(views, fit);
    result.used = static_cast<int>(used.size());
    result.residual_mm = fit.residual_mm;
    result.error_ratio = fit.error_ratio;
    require_rest(result, found.spacing_mm);
    result.pivot_rad = calibrate::pivot_angle_rad(used);
    require_pivot(result.pivot_rad);
    require_accuracy(fit, found.spacing_mm);
    const auto [least, most] = std::ranges::minmax(used, {}, tilt_rad);
    result.min_tilt_rad = tilt_rad(least);
    result.max_tilt_rad = tilt_rad(most);
    result.camera = camera;
    set_tip(fit, result.camera);
    try {
        validate(result.camera);
    } catch (const BadArgument& error) {
        throw Error(fmt::format("the pen did not pivot about one point ({})", error.what()));
    }
    return result;
}

}  // namespace dotpose

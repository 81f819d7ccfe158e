// Finds the tip of a pen from frames in which the pen pivots about its tip.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/core.h>

#include "calibrate/pivot_fit.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/space_pose.hpp"

namespace dotpose {
namespace {

using calibrate::PivotFit;
using calibrate::PivotView;

constexpr int kMinPivotFrames = 6;
/// Below this angle, the tip is less accurate than the poses by more than a factor of about 10.
constexpr double kMinPivot_rad = 3 * std::numbers::pi / 180;
constexpr double kMinUsed = 2.0 / 3;
constexpr double kDegrees_per_rad = 180 / std::numbers::pi;

/// Poses of all frames that have a pose in space.
struct PivotPoses {
    std::vector<SpacePose> poses;
    double spacing_mm = 0;  ///< spacing of the sheet in the last of these frames
};

/// Sets the spacing in `fix` and returns the print scale of its sheet. Returns none if the fix is
/// not on any of the sheets.
std::optional<AxisScale> use_spacing(const CalibrateOptions& options, CodeVariant code, Fix& fix) {
    double spacing_mm = options.pattern.spacing_mm;
    AxisScale print;
    if (!options.sheets.empty()) {
        const auto place = find_sheet(options.sheets, code, fix);
        if (!place) return std::nullopt;
        spacing_mm = place->entry->sheet.pattern.spacing_mm;
        print = place->entry->print_scale();
    }
    fix.spacing_nm = static_cast<std::int32_t>(std::lround(spacing_mm * 1e6));
    return print;
}

PivotPoses locate_poses(int frames, const FrameAt& frame_at, const Camera& camera,
                        const CalibrateOptions& options) {
    PivotPoses result;
    Camera plain = camera;
    plain.reference_px.reset();
    Locator locator{DeviceOptions{}};
    CodeReader reader(given_code(options));
    for (int i = 0; i < frames; ++i) {
        const GreyImage image = frame_at(i);
        DeviceOptions how;
        use_camera(plain, image.width_px, image.height_px, how);
        how.show_stages = true;
        locator.set_options(how);
        Fix fix = reader.locate(image.view(), locator);
        if (options.progress && !options.progress(i + 1, frames))
            throw Error("stopped; nothing was written");
        if (fix.status != Status::ok) continue;
        const auto print = use_spacing(options, reader.code(), fix);
        if (!print) continue;
        const auto pose = space_pose(fix, camera, image.view(), locator.trace(), *print);
        if (!pose || pose->is_ambiguous()) continue;
        result.poses.push_back(*pose);
        result.spacing_mm = fix.spacing_mm();
    }
    return result;
}

PivotView view_of(const SpacePose& pose) {
    const Quaternion& q = pose.camera.rotation;
    PivotView view{Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix(),
                   {pose.camera.x_mm, pose.camera.y_mm, pose.camera.z_mm},
                   {}};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            view.covariance(Eigen::Index(i), Eigen::Index(j)) = pose.covariance[i][j];
    }
    return view;
}

void require_pivot(double pivot_rad) {
    if (pivot_rad >= kMinPivot_rad) return;
    throw Error(
        fmt::format("the pen does not pivot enough: its rotations about one axis are {:.1f} "
                    "degrees (rms), and {:.0f} are needed; keep the tip at one point of the sheet, "
                    "and tilt the pen by up to 40 degrees to all sides",
                    pivot_rad * kDegrees_per_rad, kMinPivot_rad * kDegrees_per_rad));
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
    const PivotPoses found = locate_poses(frames, frame_at, camera, options);
    PivotCalibration result;
    result.frames = frames;
    result.located = static_cast<int>(found.poses.size());
    if (result.located < kMinPivotFrames) {
        throw Error(
            fmt::format("only {} of {} frames have a pose in space; at least {} are needed, "
                        "preferably 30",
                        result.located, frames, kMinPivotFrames));
    }
    std::vector<PivotView> views;
    for (const SpacePose& pose : found.poses)
        views.push_back(view_of(pose));
    require_pivot(calibrate::pivot_angle_rad(views));
    const PivotFit fit = calibrate::fit_pivot(views);
    result.used = static_cast<int>(std::ranges::count(fit.is_used, true));
    result.residual_mm = fit.residual_mm;
    result.error_ratio = fit.error_ratio;
    require_rest(result, found.spacing_mm);
    result.pivot_rad = calibrate::pivot_angle_rad(used_views(views, fit));
    require_pivot(result.pivot_rad);
    require_accuracy(fit, found.spacing_mm);
    result.min_tilt_rad = std::numbers::pi;
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!fit.is_used[i]) continue;
        const double tilt_rad = lean_of(found.poses[i].camera.rotation).tilt_rad;
        result.min_tilt_rad = std::min(result.min_tilt_rad, tilt_rad);
        result.max_tilt_rad = std::max(result.max_tilt_rad, tilt_rad);
    }
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

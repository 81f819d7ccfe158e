#include "calibrate_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "dotpose/files/code_names.hpp"
#include "dotpose/files/degrees.hpp"
#include "dotpose/tools/calibration_coverage.hpp"
#include "draw/deviation.hpp"

namespace dotpose::cli {
namespace {

using draw::plus_minus;

template <typename... Values>
void add(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
    text += '\n';
}

/// Returns the radial displacement that undistortion causes at the farthest image corner, as a
/// percentage of the corner's distance from the distortion centre. The displacement is positive if
/// the corner moves outwards.
double corner_displacement(const Camera& camera) {
    const PixelPoint corner = farthest_corner(camera);
    const PixelPoint straight = undistorted(camera, corner);
    const double r = std::hypot(corner.u - camera.centre_px.u, corner.v - camera.centre_px.v);
    return 100 *
           (std::hypot(straight.u - camera.centre_px.u, straight.v - camera.centre_px.v) / r - 1);
}

void add_view(std::string& text, const Camera& camera) {
    const auto sigma = [&camera](const char* key) { return camera.sigma.at(key); };
    if (const auto& paper = camera.paper) {
        add(text, "scale       {:.6f}{} and {:.6f}{} mm per px, along x and y", paper->mm_per_px_x,
            plus_minus(sigma("mm_per_px_x"), 6), paper->mm_per_px_y,
            plus_minus(sigma("mm_per_px_y"), 6));
        add(text, "skew        {:.5f}{}", paper->skew, plus_minus(sigma("skew"), 5));
    } else {
        add(text, "scale       differs from frame to frame: the camera was not mounted");
    }
    if (camera.tilt) {
        add(text, "tilt        {:.3f}{} and {:.3f}{} degrees about x and y",
            camera.tilt->x_rad * kDegrees, plus_minus(sigma("tilt_x_rad") * kDegrees, 3),
            camera.tilt->y_rad * kDegrees, plus_minus(sigma("tilt_y_rad") * kDegrees, 3));
    }
    if (camera.focal_px) {
        add(text, "focal       {:.2f}{} px", *camera.focal_px, plus_minus(sigma("focal_px"), 2));
    } else {
        add(text,
            "focal       cannot be determined from these frames: the camera looks straight down");
    }
}

const char* spacing_remark(SpacingSource source) {
    switch (source) {
        case SpacingSource::sheets:
            return ", of the sheet in the sheet file";
        case SpacingSource::option:
            return ", as given";
        case SpacingSource::assumed:
            break;
    }
    return ", ASSUMED: all lengths are wrong for a sheet with another one; give --sheets or "
           "--spacing";
}

}  // namespace

std::string lens_report(const LensCalibration& calibration, SpacingSource source) {
    const Camera& camera = calibration.camera;
    std::string text;
    add(text, "frames      {} of {} located{}, {} dots, {} left out", calibration.located,
        calibration.frames,
        calibration.duplicates > 0 ? fmt::format(", {} duplicates", calibration.duplicates) : "",
        calibration.dots, calibration.outliers);
    add(text, "code        {}", name(calibration.code));
    add(text, "lens        k {:.4e} +- {:.1e} per px^2: {:+.2f} % in the corner", camera.k_per_px2,
        camera.sigma.at("k_per_px2"), corner_displacement(camera));
    add(text, "centre      {:.3f}{}, {:.3f}{} px", camera.centre_px.u,
        plus_minus(camera.sigma.at("centre_u_px"), 3), camera.centre_px.v,
        plus_minus(camera.sigma.at("centre_v_px"), 3));
    add_view(text, camera);
    add(text, "dots        {:.2f} px apart, {:.0f} % of that wide, on {:.0f} % of the image",
        calibration.px_per_spacing, 100 * calibration.dot_width, 100 * calibration.coverage);
    add(text, "residual    {:.4f} px before, {:.4f} px after (rms per axis)",
        calibration.residual_before_px, calibration.residual_px);
    // The spacing affects only the scale of a mounted camera. For other cameras, the report omits
    // the spacing.
    const bool is_assumed = calibration.is_mounted && source == SpacingSource::assumed &&
                            calibration.verdict == CalibrationVerdict::good;
    if (calibration.is_mounted) {
        add(text, "spacing     {:g} mm{}", calibration.spacing_mm, spacing_remark(source));
    }
    add(text, "verdict     {}{}: {}", name(calibration.verdict),
        is_assumed ? fmt::format(" if the spacing is {:g} mm", calibration.spacing_mm) : "",
        calibration.advice);
    return text;
}

std::string corner_report(const Camera& camera) {
    std::string text;
    add(text, "corner      known to {:.3f} px; {:g} px suffice", corner_sigma_px(camera),
        kWantedCornerSigma_px);
    return text;
}

std::string spin_report(const SpinCalibration& calibration) {
    const PixelPoint reference = calibration.camera.reference_px.value();
    std::string text;
    add(text, "spin        {} of {} frames located, over {:.0f} degrees", calibration.located,
        calibration.frames, calibration.turn_rad * kDegrees);
    add(text, "reference   {:+.4f}, {:+.4f}{} mm from the image centre ({:.2f}, {:.2f} px)",
        calibration.offset_mm.x_mm, calibration.offset_mm.y_mm, plus_minus(calibration.sigma_mm, 4),
        reference.u, reference.v);
    add(text, "residual    {:.4f} mm (rms per axis): motion of the turning centre",
        calibration.residual_mm);
    add(text, "verdict     {}: {}", name(calibration.verdict),
        calibration.drift_mm > 0
            ? fmt::format("the robot moved on while it turned, which makes {:.4f} mm of the "
                          "deviation; let it turn on the spot",
                          calibration.drift_mm)
            : "one point stayed put");
    return text;
}

std::string drive_report(const DriveCalibration& calibration) {
    std::string text;
    add(text, "drive       {} of {} frames located, over {:.1f} mm", calibration.located,
        calibration.frames, calibration.length_mm);
    add(text, "heading     image x axis {:+.3f}{} degrees",
        calibration.camera.theta_offset_rad * kDegrees,
        plus_minus(calibration.sigma_rad * kDegrees, 3));
    add(text, "residual    {:.4f} mm (rms): deviation from a straight line",
        calibration.residual_mm);
    add(text, "verdict     good: straight ahead, in order");
    return text;
}

std::string pivot_report(const PivotCalibration& calibration) {
    const PenTip tip = calibration.camera.tip.value();
    const auto sigma = [&](const char* key) {
        return plus_minus(calibration.camera.sigma.at(key), 4);
    };
    std::string text;
    add(text, "pivot       {} of {} frames located, {} left out, tilts {:.0f} to {:.0f} degrees",
        calibration.located, calibration.frames, calibration.located - calibration.used,
        calibration.min_tilt_rad * kDegrees, calibration.max_tilt_rad * kDegrees);
    add(text, "tip         x {:.4f}{}, y {:.4f}{}, z {:.4f}{} mm in the frame of the camera",
        tip.x_mm, sigma("tip_x_mm"), tip.y_mm, sigma("tip_y_mm"), tip.z_mm, sigma("tip_z_mm"));
    add(text, "rest        {:.4f}{} mm above the paper", tip.rest_mm, sigma("tip_rest_mm"));
    add(text, "residual    {:.4f} mm (rms per axis), {:.2f} times the expected one",
        calibration.residual_mm, calibration.error_ratio);
    return text;
}

std::string flat_field_report(const FlatFieldCalibration& calibration) {
    std::string text;
    add(text,
        "flat field  from {} frames: the darkest point has {:.0f} % of the light of the brightest",
        calibration.frames, 100 * calibration.min_brightness);
    add(text, "residual    {:.1f} % (rms): dots in the mean, and pixels that differ",
        100 * calibration.residual);
    return text;
}

std::string readout_report(const ReadoutCalibration& calibration) {
    std::string text;
    add(text,
        "rolling     {} of {} frames located, moved by {:.2f} spacings during the readout (rms)",
        calibration.located, calibration.frames, calibration.motion);
    add(text, "readout     {:.3f}{} ms from the first to the last row",
        calibration.camera.readout_ms.value_or(0), plus_minus(calibration.sigma_ms, 3));
    return text;
}

namespace {

std::string print_scale_text(double scale, double sigma) {
    return fmt::format("{:.6f}{}{}", scale, plus_minus(sigma, 6),
                       is_scale_known(sigma) ? "" : " (UNKNOWN)");
}

/// Appends the print scales of the sheets, and a line that names the sheet or camera that
/// determines the absolute scale.
void add_print_scales(std::string& text, const Stitching& stitching) {
    bool are_all_scales_known = true;
    std::string fixed;
    for (const StitchedSheet& sheet : stitching.stitched) {
        const auto entry = std::ranges::find(stitching.sheets, sheet.name, &SheetEntry::name);
        add(text, "print       {}: {} along x, {} along y", sheet.name,
            print_scale_text(entry->print_scale_x, sheet.sigma_scale_x),
            print_scale_text(entry->print_scale_y, sheet.sigma_scale_y));
        are_all_scales_known = are_all_scales_known && is_scale_known(sheet.sigma_scale_x) &&
                               is_scale_known(sheet.sigma_scale_y);
        if (sheet.is_fixed) fixed = sheet.name;
    }
    using By = ScaleReference::By;
    switch (stitching.reference.by) {
        case By::camera:
            add(text, "scale       by the camera's mm per px");
            break;
        case By::width:
            add(text, "scale       by the true width of {}, {:g} mm", stitching.reference.sheet,
                stitching.reference.width_mm);
            break;
        default:
            add(text,
                "scale       relative to {}, whose mean scale is kept: only --true-scale gives "
                "true millimetres",
                fixed);
    }
    if (!are_all_scales_known) {
        add(text,
            "UNKNOWN:    these frames do not determine the scales: use the camera file of a "
            "mounted camera (with mm_per_px) and frames at several angles");
    }
}

}  // namespace

std::string stitching_report(const Stitching& stitching) {
    std::string text;
    add(text, "frames      {} of {} show two sheets", stitching.used, stitching.frames);
    for (const Seam& seam : stitching.seams) {
        add(text, "seam        {} - {}: {} frames, residual {:.4f} mm, {:.3f} degrees (rms)",
            seam.first, seam.second, seam.frames, seam.residual_mm, seam.residual_rad * kDegrees);
    }
    for (const StitchedSheet& sheet : stitching.stitched) {
        if (sheet.is_fixed) {
            add(text, "sheet       {}: stays where it is", sheet.name);
        } else {
            add(text, "sheet       {}:{} mm,{} degrees", sheet.name, plus_minus(sheet.sigma_mm, 4),
                plus_minus(sheet.sigma_rad * kDegrees, 4));
        }
    }
    add_print_scales(text, stitching);
    for (const std::string& name : stitching.unconnected)
        add(text, "NOT FOUND:  {}: no frame shows it beside another one", name);
    return text;
}

}  // namespace dotpose::cli

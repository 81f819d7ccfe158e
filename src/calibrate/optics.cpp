#include "dotpose/tools/optics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/core.h>

namespace dotpose {
namespace {

constexpr double kRadPerS_per_rpm = 2 * std::numbers::pi / 60;
/// Spacing in the image for which `locate` is designed: minimum, recommended minimum, and maximum.
constexpr double kMinSpacing_px = 6;
constexpr double kGoodSpacing_px = 8;
constexpr double kMaxSpacing_px = 60;
constexpr double kMinDot_px = 1.5;

void require(bool is_good, std::string_view what) {
    if (!is_good) throw BadArgument(std::string(what));
}

void validate(const Optics& o) {
    require(o.width_px >= 1 && o.height_px >= 1, "the sensor must have pixels");
    for (const double length :
         {o.pixel_um, o.focal_mm, o.distance_mm, o.spacing_mm, o.dot_mm, o.f_number, o.exposure_s,
          o.largest_blur_px, o.mm_per_px.value_or(1), o.field_width_mm.value_or(1),
          o.field_height_mm.value_or(1)}) {
        require(length > 0 && std::isfinite(length), "all lengths and times must be above 0");
    }
    require(o.speed_mm_s >= 0 && o.turn_rpm >= 0, "speed and turn rate must not be below 0");
    require(o.distance_mm > o.focal_mm,
            fmt::format("a lens of {:g} mm cannot focus at {:g} mm: the distance must be more than "
                        "the focal length",
                        o.focal_mm, o.distance_mm));
}

void set_field(const Optics& o, OpticsReport& r) {
    r.magnification = o.focal_mm / (o.distance_mm - o.focal_mm);  // thin lens
    r.mm_per_px = o.mm_per_px.value_or(o.pixel_um / 1000 / r.magnification);
    r.px_per_spacing = o.spacing_mm / r.mm_per_px;
    r.px_per_dot = o.dot_mm / r.mm_per_px;
    r.field_width_mm = o.field_width_mm.value_or(o.width_px * r.mm_per_px);
    r.field_height_mm = o.field_height_mm.value_or(o.height_px * r.mm_per_px);
    r.field_diagonal_mm = std::hypot(r.field_width_mm, r.field_height_mm);
    r.field_angle_rad = 2 * std::atan(r.field_diagonal_mm / 2 / o.distance_mm);
    r.dots_in_view = r.field_width_mm * r.field_height_mm / (o.spacing_mm * o.spacing_mm);
}

/// Determines whether the field of view contains 8 x 8 dots (paper, section III-A.3).
void set_block(const Optics& o, OpticsReport& r) {
    const double side_mm = o.spacing_mm * (7 + 2.0 / 6) + o.dot_mm;
    r.block_diagonal_mm = std::numbers::sqrt2 * side_mm;
    // For any position of the grid, the centre of some block of 8 x 8 dots is at most half the
    // diagonal of a cell from the image centre. If the pattern is rotated by 45 degrees, this
    // offset can be parallel to an image axis. The field must then be larger by half the diagonal
    // on each side.
    r.block_anywhere_mm = r.block_diagonal_mm + std::numbers::sqrt2 * o.spacing_mm;
    const double shorter_mm = std::min(r.field_width_mm, r.field_height_mm);
    r.block_fits = shorter_mm >= r.block_diagonal_mm;
    r.block_fits_anywhere = shorter_mm >= r.block_anywhere_mm;
}

/// Computes the motion limits (paper, section III-A.2). Blur is measured along the image axes. If
/// the camera turns about the image centre, the largest velocity along an image axis occurs at the
/// edges farthest from the centre. The effective radius is therefore half the longer side of the
/// image.
void set_motion(const Optics& o, OpticsReport& r) {
    const double blur_mm = o.largest_blur_px * r.mm_per_px;
    const double radius_mm = std::max(r.field_width_mm, r.field_height_mm) / 2;
    r.fastest_mm_s = blur_mm / o.exposure_s;
    r.fastest_turn_rpm = r.fastest_mm_s / radius_mm / kRadPerS_per_rpm;
    const double motion_mm_s = o.speed_mm_s + o.turn_rpm * kRadPerS_per_rpm * radius_mm;
    r.longest_exposure_s = motion_mm_s > 0 ? blur_mm / motion_mm_s : HUGE_VAL;
    r.blur_px = motion_mm_s * o.exposure_s / r.mm_per_px;
}

/// Computes the limits of the depth of field: the distances at which the image of a point is
/// blurred to the width of one pixel.
void set_depth(const Optics& o, OpticsReport& r) {
    const double squared = o.focal_mm * o.focal_mm;
    const double spread = o.f_number * o.pixel_um / 1000 * (o.distance_mm - o.focal_mm);
    r.near_mm = o.distance_mm * squared / (squared + spread);
    r.far_mm = squared > spread ? o.distance_mm * squared / (squared - spread) : HUGE_VAL;
}

void advise_on_scale(const Optics& o, OpticsReport& r) {
    const auto say = [&r](bool is_fault, std::string text) {
        r.advice.push_back({is_fault, std::move(text)});
    };
    // Returns the distance from the lens to the paper at which the spacing is `px` pixels.
    const auto distance_mm = [&](double px) {
        return o.focal_mm * (1 + o.spacing_mm / px / (o.pixel_um / 1000));
    };
    if (r.px_per_spacing < kMinSpacing_px) {
        say(true,
            fmt::format(
                "a spacing of {:.1f} px is too small: at least {:g} px are needed, {:g} px are "
                "good; go closer ({:.1f} mm), or take more pixels or a longer lens",
                r.px_per_spacing, kMinSpacing_px, kGoodSpacing_px, distance_mm(kGoodSpacing_px)));
    } else if (r.px_per_spacing < kGoodSpacing_px) {
        say(false, fmt::format("a spacing of {:.1f} px is enough only with sharp, even images; "
                               "{:g} px are good ({:.1f} mm away)",
                               r.px_per_spacing, kGoodSpacing_px, distance_mm(kGoodSpacing_px)));
    } else if (r.px_per_spacing > kMaxSpacing_px) {
        say(true, fmt::format("a spacing of {:.1f} px is larger than {:g} px: bin pixels",
                              r.px_per_spacing, kMaxSpacing_px));
    }
    if (r.px_per_dot < kMinDot_px) {
        say(true,
            fmt::format("a dot of {:.1f} px is hardly visible: print larger dots", r.px_per_dot));
    }
}

void advise(const Optics& o, OpticsReport& r) {
    const auto say = [&r](bool is_fault, std::string text) {
        r.advice.push_back({is_fault, std::move(text)});
    };
    advise_on_scale(o, r);
    const double shorter_mm = std::min(r.field_width_mm, r.field_height_mm);
    if (!r.block_fits) {
        say(true,
            fmt::format("8 x 8 dots do not fit at every angle: the shorter side of the field is "
                        "{:.2f} mm, {:.2f} mm are needed; enlarge the field (shorter focal length, "
                        "more distance, larger sensor) or print a spacing of {:.3f} mm",
                        shorter_mm, r.block_diagonal_mm,
                        o.spacing_mm * shorter_mm / r.block_diagonal_mm));
    } else if (!r.block_fits_anywhere) {
        say(false, fmt::format("8 x 8 dots fit at every angle, but not at every position of the "
                               "grid: at 45 degrees, the field would need {:.2f} mm; dotpose reads "
                               "all dots in view, not just 8 x 8",
                               r.block_anywhere_mm));
    }
    if (r.blur_px > o.largest_blur_px) {
        say(true,
            fmt::format("motion blurs the image by {:.1f} px: expose for at most 1/{:.0f} s, with "
                        "{:.1f} times the light",
                        r.blur_px, 1 / r.longest_exposure_s, r.blur_px / o.largest_blur_px));
    }
    constexpr double kMinDepth_mm = 0.5;
    if (r.depth_mm() < kMinDepth_mm) {
        say(true,
            fmt::format(
                "the image is sharp over only {:.2f} mm of height: close the aperture to f/{:.1f}",
                r.depth_mm(), o.f_number * kMinDepth_mm / r.depth_mm()));
    }
    if (r.advice.empty()) say(false, "nothing needs to be changed");
}

}  // namespace

Optics paper_optics() {
    Optics optics;
    optics.mm_per_px = 0.046;
    optics.field_width_mm = 8.59;
    optics.field_height_mm = 5.48;
    return optics;
}

OpticsReport design_optics(const Optics& optics) {
    validate(optics);
    OpticsReport report;
    set_field(optics, report);
    set_block(optics, report);
    set_motion(optics, report);
    set_depth(optics, report);
    advise(optics, report);
    return report;
}

}  // namespace dotpose

/// Optics: predicts how the pattern appears in the images of a camera with given components.
/// Intended for the design of a device (paper, section III-A). The model is a thin lens focused on
/// the paper.
///
///     const OpticsReport report = design_optics(paper_optics());
///     for (const OpticsAdvice& advice : report.advice) puts(advice.text.c_str());
///
/// The functions are pure and throw BadArgument for invalid values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Components and motion of a device. Speed and turn rate must not be negative, and all other
/// values must be positive.
struct Optics {
    int width_px = 188;
    int height_px = 120;
    double pixel_um = 24;     ///< pixel pitch on the sensor, after binning
    double focal_mm = 5.5;    ///< focal length of the lens
    double distance_mm = 16;  ///< distance from the lens to the paper, greater than `focal_mm`
    double spacing_mm = kDefaultSpacing_mm;
    double dot_mm = kDefaultSpacing_mm / 6;
    double f_number = 2.8;  ///< focal length divided by the diameter of the aperture
    double exposure_s = 1.0 / 7684;
    double speed_mm_s = 100;  ///< maximum speed of straight motion along the image x or y axis
    double turn_rpm = 60;     ///< maximum turn rate about the image centre
    /// Maximum permitted motion in the image during the exposure, in px.
    double largest_blur_px = 1;

    /// Measured size of a pixel on the paper, and measured field of view after distortion
    /// correction. Values given here replace the values computed with the thin-lens model.
    std::optional<double> mm_per_px;
    std::optional<double> field_width_mm;
    std::optional<double> field_height_mm;
};

/// Returns the device described in the paper: an MT9V034 with 6 um pixels binned 4 x 4, a 5.5 mm
/// lens, 0.046 mm per px, and a field of 8.59 x 5.48 mm.
Optics paper_optics();

/// One fault or remark about a device.
struct OpticsAdvice {
    bool is_fault = false;  ///< true for a fault in the device, false for a remark
    std::string text;       ///< one sentence: the fault and the remedy
};

/// Predicted properties of the pattern's image.
struct OpticsReport {
    double magnification = 0;
    double mm_per_px = 0;
    double px_per_spacing = 0;
    double px_per_dot = 0;
    double field_width_mm = 0;
    double field_height_mm = 0;
    double field_diagonal_mm = 0;
    double field_angle_rad = 0;  ///< angle of view along the diagonal of the field
    double dots_in_view = 0;     ///< mean number of dots in the field

    /// Maximum diagonal of a block of 8 x 8 dots that are displaced by a sixth of the spacing:
    /// sqrt(2) (spacing (7 + 2/6) + diameter of a dot).
    double block_diagonal_mm = 0;
    /// True if the shorter side of the field is at least `block_diagonal_mm` (paper, section
    /// III-A.3).
    bool block_fits = false;
    /// Minimum side length of a square field of view that contains 8 x 8 dots for any position and
    /// angle of the grid. The worst case is an angle of 45 degrees: block_diagonal_mm + sqrt(2)
    /// spacing.
    double block_anywhere_mm = 0;
    bool block_fits_anywhere = false;

    double fastest_mm_s = 0;  ///< maximum speed at the given exposure, without rotation
    /// Maximum turn rate about the image centre at the given exposure, without straight motion. The
    /// blur is evaluated at the middle of the image edge that is farthest from the image centre.
    double fastest_turn_rpm = 0;
    /// Maximum exposure at the given speed and turn rate. Infinite if the speed and the turn rate
    /// are 0.
    double longest_exposure_s = 0;
    double blur_px = 0;  ///< blur at the given speed, turn rate and exposure

    /// Distances from the lens at which the defocus blur is one pixel. `near_mm` is less than the
    /// focused distance, and `far_mm` is greater. `far_mm` may be infinite.
    double near_mm = 0;
    double far_mm = 0;
    double depth_mm() const { return far_mm - near_mm; }

    std::vector<OpticsAdvice> advice;
};

/// Computes the report on a device. Throws BadArgument if a value is out of range, or if the
/// distance does not exceed the focal length.
OpticsReport design_optics(const Optics& optics);

}  // namespace dotpose

DOTPOSE_END_EXPORT

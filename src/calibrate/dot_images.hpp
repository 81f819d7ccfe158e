// Dot images: measures the centres of expected dots by least squares over their pixels. Dots at the
// border of the image, and dots that a tilted view foreshortens, are measured without bias.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "dotpose/image.hpp"

namespace dotpose::calibrate {

/// A dot that is expected in an image.
struct ExpectedDot {
    Eigen::Vector2d pixel;
    /// Derivative of the pixel with respect to the place on the paper, per spacing.
    Eigen::Matrix2d px_per_spacing;
};

/// Minimum length of a spacing in the image, in px, along the direction in which it is shortest.
/// Images of neighbouring dots with smaller spacings overlap.
inline constexpr double kMinSpacing_px = 4;

/// Returns true if a dot is completely in the image and its spacing is long enough.
bool is_measurable(const ImageView& image, const ExpectedDot& dot);

/// Centre of a dot in an image.
struct DotCentre {
    Eigen::Vector2d pixel;
    /// Covariance for noise of the image with a standard deviation of one grey level.
    Eigen::Matrix2d covariance;
};

/// Returns the centres of measurable dots. Returns none for a dot that is missing or much paler
/// than the others.
std::vector<std::optional<DotCentre>> measured_centres(const ImageView& image,
                                                       const std::vector<ExpectedDot>& dots);

}  // namespace dotpose::calibrate

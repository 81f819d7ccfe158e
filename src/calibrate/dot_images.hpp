// Measures the centres of expected dots by least-squares fits to their pixels. The measurement is
// unbiased even for dots at the border of the image and for dots foreshortened by a tilted view.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "dotpose/image.hpp"

namespace dotpose::calibrate {

/// A dot that the code predicts in an image.
struct ExpectedDot {
    Eigen::Vector2d pixel;
    /// Derivative of `pixel` with respect to the position on the paper, in px per spacing.
    Eigen::Matrix2d px_per_spacing;
};

/// Minimum spacing of dots that can be measured, in px. The spacing is measured in the direction in
/// which it is smallest. At smaller spacings, the images of neighbouring dots overlap.
inline constexpr double kMinSpacing_px = 4;

/// Returns true if a dot is entirely inside the image and its spacing is at least kMinSpacing_px.
bool is_measurable(const ImageView& image, const ExpectedDot& dot);

/// Centre of a dot in an image.
struct DotCentre {
    Eigen::Vector2d pixel;
    /// Covariance for image noise with a standard deviation of one grey level.
    Eigen::Matrix2d covariance;
};

/// Returns one element per dot: its centre, or nullopt if the dot is missing or much paler than the
/// other dots. All dots must be measurable.
std::vector<std::optional<DotCentre>> measured_centres(const ImageView& image,
                                                       const std::vector<ExpectedDot>& dots);

}  // namespace dotpose::calibrate

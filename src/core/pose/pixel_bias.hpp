// Pixel bias: corrects the centroid bias due to the sub-pixel phase of the dots. The bias averages
// out if the phases are evenly distributed. If all dots have the same phase, the bias is computed
// from a model dot and subtracted. The frames in the paper contain all phases, and therefore do not
// need this correction.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Parameters of the centroid windows in which the dots were measured.
struct CentroidWindow {
    float radius_px = 0;      ///< radius of each window, beyond which the weight is 0
    float dot_radius_px = 0;  ///< approximate dot radius
    /// Origin of the dot coordinates, in px relative to the centre of the top left pixel.
    FloatVec centre_px;
};

/// Moves each window to the current centre of its dot. The dots must be measured again afterwards.
/// Drops dots whose windows extend beyond the image.
void recentre_windows(const ImageView& image, const CentroidWindow& window, MeasuredDots& dots);

/// Subtracts the bias from the centres of all inliers. The remaining bias makes the mean of all
/// centres uncertain. Returns the variance of this mean along u and v, in px^2. If the bias is
/// negligible or cannot be determined, changes nothing and returns (0, 0).
FloatVec correct_pixel_bias(const ImageView& image, const CentroidWindow& window,
                            const FloatPlane& plane, const PoseFit& fit, MeasuredDots& dots);

}  // namespace dotpose::core

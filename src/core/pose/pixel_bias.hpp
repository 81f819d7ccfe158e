// Pixel bias: corrects the bias of the centroids due to the sub-pixel phase of the dots. If the
// phases of the dots are evenly distributed, the bias averages out. If all dots have the same
// phase, the bias is computed from a model dot and subtracted. Differs: the paper needs no such
// correction, because its frames contain all phases.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// The centroid window with which the centres of the dots were measured.
struct CentroidWindow {
    float radius_px = 0;      ///< distance from the centre at which the weight becomes 0, in px
    float dot_radius_px = 0;  ///< approximate radius of the dots, in px
    /// Origin of the coordinates of the dots, in px relative to the first pixel of the image.
    FloatVec centre_px;
};

/// Moves the centroid windows to the current centres, before the dots are measured again. Drops
/// dots whose window is not completely in the image.
void recentre_windows(const ImageView& image, const CentroidWindow& window, MeasuredDots& dots);

/// Subtracts the bias from the centres of all inliers of the plane. Returns the variance of the
/// mean of all centres that is due to the remaining bias, along u and v, in px^2. If the bias is
/// negligible or cannot be determined, changes no centre and returns 0.
FloatVec correct_pixel_bias(const ImageView& image, const CentroidWindow& window,
                            const FloatPlane& plane, const PoseFit& fit, MeasuredDots& dots);

}  // namespace dotpose::core

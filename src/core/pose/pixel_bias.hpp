// Pixel bias: what centres of dots are off because of how the dots fall on the pixels. It averages
// out over dots that fall on them in all ways; where all fall on them alike, it is computed from a
// model dot and taken away. differs: the paper's dots turn in the view, and it has no such frames.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/math/float_plane.hpp"
#include "core/pose/refine_pose.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// The bells by which the centres of dots were found.
struct Bells {
    float reach_px = 0;
    float dot_radius_px = 0;  ///< about as large as the dots are
    FloatVec centre_px;       ///< from the image's first pixel to where dots are counted from
};

/// Makes the centres found so far the places of the bells, for looking at the dots once more. Drops
/// dots around which a bell does not fit into the image.
void put_bells_on_centres(const ImageView& image, const Bells& bells, MeasuredDots& dots);

/// Takes the bias from the dots that lie where the plane has them. Returns the variance that is
/// left of the mean of all centres, along u and v, px^2.
FloatVec take_pixel_bias(const ImageView& image, const Bells& bells, const FloatPlane& plane,
                         const PoseFit& fit, MeasuredDots& dots);

}  // namespace dotpose::core

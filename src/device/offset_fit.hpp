// Offset fit: corrects a plane, given the offsets of dots from their expected centres. Uses 32-bit
// arithmetic.
#pragma once

#include "core/math/fixed.hpp"
#include "device/tracking.hpp"
#include "dotpose/geometry.hpp"

namespace dotpose::core {

/// Fits an affine function of the image coordinates to the offsets, by least squares. Rounding
/// causes a relative error of about 1 %, which is acceptable because the offsets are small.
class OffsetFit {
  public:
    /// Adds a dot and its offset, in 2^-24 cells. The offset must be at most 2^21, an eighth of a
    /// cell, along each axis. This limit ensures that the sums over 2^9 dots are at most 2^27, so
    /// they fit in 32 bits.
    [[gnu::always_inline]] void add(const DetectedDot& dot, FixedVec offset_q24) {
        const FixedVec r{offset_q24.x >> 12, offset_q24.y >> 12};
        const FixedVec p{dot.centre_q8.x >> 6, dot.centre_q8.y >> 6};
        ++count_;
        p_ = p_ + p;
        r_ = r_ + r;
        xx_ += p.x * p.x;
        xy_ += p.x * p.y;
        yy_ += p.y * p.y;
        of_x_ = of_x_ + FixedVec{p.x * r.x, p.x * r.y};
        of_y_ = of_y_ + FixedVec{p.y * r.x, p.y * r.y};
    }
    int count() const { return count_; }
    /// Subtracts the fitted offsets from a plane whose centre is the middle of the image. Requires
    /// at least one dot. Returns false and leaves the plane unchanged if the dots are nearly
    /// collinear.
    bool correct(PlaneFromImage& plane) const;

  private:
    std::int32_t count_ = 0;
    // Units of the sums: coordinates p = (x, y) are in 1/4 px, offsets r are in 2^-12 cells.
    FixedVec p_;
    FixedVec r_;
    std::int32_t xx_ = 0;
    std::int32_t xy_ = 0;
    std::int32_t yy_ = 0;
    FixedVec of_x_;
    FixedVec of_y_;
};

}  // namespace dotpose::core

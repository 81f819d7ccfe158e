// Least squares of an affine map between two sets of points, in 64-bit integer arithmetic.
#pragma once

#include <cstdint>

#include "core/math/fixed.hpp"

namespace dotpose::core {

/// An affine map: target = offset + dx * source.x + dy * source.y. All members are scaled by
/// 2^fraction_bits.
struct AffineMap {
    FixedVec dx;
    FixedVec dy;
    std::int64_t offset_x = 0;
    std::int64_t offset_y = 0;
};

/// Accumulates at most 2^14 pairs of points, with |source|, |target| < 2^24, and solves for the
/// affine map.
class AffineFitInt64 {
  public:
    void add(FixedVec source, FixedVec target);
    int count() const { return static_cast<int>(n_); }
    /// Sets the map to the least-squares solution. Returns false if the points are collinear. The
    /// entries of dx and dy must fit in 31 bits.
    bool solve(int fraction_bits, AffineMap& map) const;

    /// Second moments of the sources about their mean: n times their covariance matrix.
    struct Moments {
        std::int64_t xx = 0;
        std::int64_t xy = 0;
        std::int64_t yy = 0;
    };
    Moments source_moments() const;
    FixedVec source_mean() const;

  private:
    std::int64_t n_ = 0;
    std::int64_t sx_ = 0, sy_ = 0, tx_ = 0, ty_ = 0;
    std::int64_t sxsx_ = 0, sxsy_ = 0, sysy_ = 0;
    std::int64_t sxtx_ = 0, sxty_ = 0, sytx_ = 0, syty_ = 0;
};

}  // namespace dotpose::core

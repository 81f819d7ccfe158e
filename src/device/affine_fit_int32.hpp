// Affine fit: least-squares map from image points to the grid. Uses 32-bit sums, which are fast on
// small processors.
#pragma once

#include "core/math/fixed.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Accumulates image points and their grid coordinates, and computes the affine map from the points
/// to the coordinates.
class AffineFitInt32 {
  public:
    template <typename Int>
    struct Products {
        Int xx = 0, xy = 0, yy = 0;
        Int ix = 0, iy = 0, jx = 0, jy = 0;

        /// Adds the products of a point p and its target. `weighted` is p multiplied by its weight,
        /// which is 1 or -1. `target` must already be multiplied by the same weight.
        [[gnu::always_inline]] void add(const FixedVec& p, const FixedVec& weighted,
                                        const FixedVec& target) {
            xx += weighted.x * p.x;
            xy += weighted.x * p.y;
            yy += weighted.y * p.y;
            ix += target.x * p.x;
            iy += target.x * p.y;
            jx += target.y * p.x;
            jy += target.y * p.y;
        }
    };

    AffineFitInt32() = default;
    /// Constructs the fit from precomputed sums. `count` is the number of points, `p` and `target`
    /// are the sums of the points and of their targets, and `sums` contains the sums of their
    /// products. If the points have weights, all of these sums are weighted, and `count` is the
    /// total weight.
    AffineFitInt32(std::int32_t count, const FixedVec& p, const FixedVec& target,
                   const Products<std::int32_t>& sums)
        : changes_(count), p_(p), target_(target), recent_(sums) {}

    /// Adds an image point p and its target. p is relative to the plane centre, in 1/8 px, and at
    /// most 2048 px from it along each axis. The target is in units of 2^-bits cells (see `solve`),
    /// and less than 2^15 in magnitude.
    [[gnu::always_inline]] void add(const FixedVec& p, const FixedVec& target) {
        change(p, p, target);
    }
    /// Adds a point if `weight` is 1. If `weight` is -1, removes a point that was added before. The
    /// units and ranges of p and of the target are the same as for `add`.
    [[gnu::always_inline]] void count(const FixedVec& p, const FixedVec& target, int weight) {
        unused_ += 1 - weight;
        change(p, FixedVec{weight * p.x, weight * p.y},
               FixedVec{weight * target.x, weight * target.y});
    }
    int count() const { return changes_ - unused_; }
    /// Sets `at_centre`, du and dv of the plane, but no other members. Targets are in units of
    /// 2^-bits cells. Returns false and leaves the plane unchanged if there are fewer than three
    /// points, or if the points are nearly collinear.
    bool solve(int bits, PlaneFromImage& plane);

  private:
    /// A point is near if both of its coordinates are in [-kNear, kNear). The products of near
    /// points are summed in 32 bits, because small processors add 32-bit numbers three times as
    /// fast as 64-bit numbers. The sums over kMaxRecent near points and one far point do not
    /// overflow.
    static constexpr std::uint32_t kNear = 1024;
    static constexpr int kMaxRecent = 32;
    static std::uint32_t offset(std::int32_t a) { return static_cast<std::uint32_t>(a) + kNear; }

    [[gnu::always_inline]] void change(const FixedVec& p, const FixedVec& weighted,
                                       const FixedVec& target) {
        p_ = p_ + weighted;
        target_ = target_ + target;
        recent_.add(p, weighted, target);
        ++changes_;
        const bool is_far = (offset(p.x) | offset(p.y)) / (2 * kNear) != 0;
        if (is_far || changes_ % kMaxRecent == 0) carry_over();
    }
    /// Adds the recent 32-bit sums to the 64-bit sums.
    void carry_over();
    /// Returns n^2 times the covariance of two coordinates of n points. `products` is the sum of
    /// the products of the coordinates, and a and b are the sums of the coordinates.
    std::int64_t moment(std::int64_t products, std::int32_t a, std::int32_t b) const;

    std::int32_t changes_ = 0;
    std::int32_t unused_ = 0;  ///< `changes_` minus the number of points in the fit
    FixedVec p_;
    FixedVec target_;
    Products<std::int32_t> recent_;
    Products<std::int64_t> all_;
};

}  // namespace dotpose::core

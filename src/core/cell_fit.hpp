// Least-squares map from image points to the grid, without perspective or lens, in sums that
// small processors add up quickly.
#pragma once

#include "core/fixed.hpp"
#include "dotpose/stages.hpp"

namespace dotpose::core {

class CellFit {
  public:
    /// Image points in 1/8 px from the plane's centre, within 2048 px; targets within 2^15.
    [[gnu::always_inline]] void add(const Vec& p, const Vec& target) {
        ++n_;
        p_ = p_ + p;
        target_ = target_ + target;
        recent_.add(p, target);
        const bool is_far = (offset(p.x) | offset(p.y)) >= 2 * kNear;
        if (is_far || n_ % kMostRecent == 0) carry_over();
    }
    int count() const { return n_; }
    /// Sets all of the plane but its centre, perspective and lens; targets were in 2^-bits cells.
    /// False where the points lie on one line.
    bool solve(int bits, PlaneFromImage& plane);

  private:
    /// Image points from -kNear to kNear - 1: products of so many of them, and one of a point that
    /// is farther off, fit 32 bits, which small processors add up three times as fast.
    static constexpr std::uint32_t kNear = 1024;
    static constexpr int kMostRecent = 32;
    static std::uint32_t offset(std::int32_t a) { return static_cast<std::uint32_t>(a) + kNear; }

    template <typename Int>
    struct Products {
        Int xx = 0, xy = 0, yy = 0;
        Int ix = 0, iy = 0, jx = 0, jy = 0;

        [[gnu::always_inline]] void add(const Vec& p, const Vec& target) {
            xx += p.x * p.x;
            xy += p.x * p.y;
            yy += p.y * p.y;
            ix += target.x * p.x;
            iy += target.x * p.y;
            jx += target.y * p.x;
            jy += target.y * p.y;
        }
    };
    void carry_over() {
        all_.xx += recent_.xx;
        all_.xy += recent_.xy;
        all_.yy += recent_.yy;
        all_.ix += recent_.ix;
        all_.iy += recent_.iy;
        all_.jx += recent_.jx;
        all_.jy += recent_.jy;
        recent_ = {};
    }
    /// n^2 times the covariance of what has this sum of products and these sums.
    std::int64_t moment(std::int64_t products, std::int32_t a, std::int32_t b) const;

    std::int32_t n_ = 0;
    Vec p_;
    Vec target_;
    Products<std::int32_t> recent_;
    Products<std::int64_t> all_;
};

}  // namespace dotpose::core

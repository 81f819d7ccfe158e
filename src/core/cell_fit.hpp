// Least-squares map from image points to the grid, without perspective or lens, in sums that
// small processors add up quickly.
#pragma once

#include "core/fixed.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

class CellFit {
  public:
    /// Image points in 1/8 px from the plane's centre, within 2048 px; targets within 2^15.
    void add(Vec p, Vec target) {
        p_ = p_ + p;
        target_ = target_ + target;
        recent_.xx += p.x * p.x;
        recent_.xy += p.x * p.y;
        recent_.yy += p.y * p.y;
        recent_.ix += target.x * p.x;
        recent_.iy += target.x * p.y;
        recent_.jx += target.y * p.x;
        recent_.jy += target.y * p.y;
        if (++n_ % kMostRecent == 0) carry_over();
    }
    int count() const { return n_; }
    /// Sets all of the plane but its centre, perspective and lens; targets were in 2^-bits cells.
    /// False where the points lie on one line.
    bool solve(int bits, PlaneFromImage& plane);

  private:
    /// Products of so many points fit 32 bits, which small processors add up three times as fast.
    static constexpr int kMostRecent = 4;
    template <typename Int>
    struct Products {
        Int xx = 0, xy = 0, yy = 0;
        Int ix = 0, iy = 0, jx = 0, jy = 0;
    };
    void carry_over();
    /// n^2 times the covariance of what has this sum of products and these sums.
    std::int64_t moment(std::int64_t products, std::int32_t a, std::int32_t b) const {
        return n_ * products - std::int64_t{a} * b;
    }

    std::int32_t n_ = 0;
    Vec p_;
    Vec target_;
    Products<std::int32_t> recent_;
    Products<std::int64_t> all_;
};

}  // namespace dotpose::core

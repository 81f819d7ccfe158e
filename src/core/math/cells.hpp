// Cells: fast mapping of image points to grid cells, in 32-bit arithmetic, for planes without
// perspective or lens distortion.
#pragma once

#include "core/math/plane.hpp"

namespace dotpose::core {

class Cells {
  public:
    explicit Cells(const PlaneFromImage& plane)
        : rounding_centre_q8_(plane.centre_q8 - FixedVec{16, 16}),
          rounding_at_centre_q16_(plane.at_centre_q16 + FixedVec{kHalf_q16, kHalf_q16}),
          du_q18_{plane.du_q24.x >> 6, plane.du_q24.y >> 6},
          dv_q18_{plane.dv_q24.x >> 6, plane.dv_q24.y >> 6} {}

    /// Returns the offset of an image point from the plane centre, in 1/8 px. The rounding error is
    /// at most 1/16 px, about 1 % of the smallest supported spacing.
    FixedVec from_centre_q3(FixedVec image_point_q8) const {
        const FixedVec p = image_point_q8 - rounding_centre_q8_;
        return {p.x >> 5, p.y >> 5};
    }
    /// Returns the plane point for an offset from the plane centre, in 2^-16 spacings. Valid within
    /// 512 spacings of the centre.
    FixedVec plane_point_q16(FixedVec from_centre_q3) const {
        return rounding_plane_point_q16(from_centre_q3) - FixedVec{kHalf_q16, kHalf_q16};
    }
    /// Returns the plane point plus half a spacing along both axes, so the integer part of the
    /// result is the nearest cell.
    FixedVec rounding_plane_point_q16(FixedVec p) const {
        return {rounding_at_centre_q16_.x + ((du_q18_.x * p.x + dv_q18_.x * p.y) >> 5),
                rounding_at_centre_q16_.y + ((du_q18_.y * p.x + dv_q18_.y * p.y) >> 5)};
    }
    /// Returns the cell nearest to a point, and the point's offset from that cell's intersection,
    /// in 2^-16 spacings (paper, equations 3-5).
    GridPoint operator()(FixedVec from_centre_q3) const {
        const FixedVec c = rounding_plane_point_q16(from_centre_q3);
        return {{c.x >> 16, c.y >> 16}, {(c.x & 0xFFFF) - kHalf_q16, (c.y & 0xFFFF) - kHalf_q16}};
    }

  private:
    static constexpr std::int32_t kHalf_q16 = 1 << 15;

    // Plane centre, shifted by -1/16 px so that a right shift rounds to the nearest 1/8 px.
    FixedVec rounding_centre_q8_;
    // Plane coordinates of the centre, plus half a spacing so that a right shift rounds to the
    // nearest cell.
    FixedVec rounding_at_centre_q16_;
    FixedVec du_q18_;
    FixedVec dv_q18_;
};

}  // namespace dotpose::core

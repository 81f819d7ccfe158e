// Cells: the grid cells of many points, for a plane without perspective or lens, in 32 bits.
#pragma once

#include "core/plane.hpp"

namespace dotpose::core {

class Cells {
  public:
    explicit Cells(const PlaneFromImage& plane)
        : centre_q8_(plane.centre_q8),
          at_centre_q16_(plane.at_centre_q16),
          du_q18_{plane.du_q24.x >> 6, plane.du_q24.y >> 6},
          dv_q18_{plane.dv_q24.x >> 6, plane.dv_q24.y >> 6} {}

    /// In 1/8 px, which is 1/100 of the finest spacing when rounded.
    Vec from_centre_q3(Vec image_point_q8) const {
        return {(image_point_q8.x - centre_q8_.x + 16) >> 5,
                (image_point_q8.y - centre_q8_.y + 16) >> 5};
    }
    /// In spacings. At most 512 of them from the centre.
    Vec plane_point_q16(Vec from_centre_q3) const {
        const Vec p = from_centre_q3;
        return {at_centre_q16_.x + ((du_q18_.x * p.x + dv_q18_.x * p.y) >> 5),
                at_centre_q16_.y + ((du_q18_.y * p.x + dv_q18_.y * p.y) >> 5)};
    }
    /// Eq. 3-5.
    GridPoint operator()(Vec from_centre_q3) const {
        const Vec c = plane_point_q16(from_centre_q3);
        const Vec cell{(c.x + 32768) >> 16, (c.y + 32768) >> 16};
        return {cell, {c.x - cell.x * 65536, c.y - cell.y * 65536}};
    }

  private:
    Vec centre_q8_;
    Vec at_centre_q16_;
    Vec du_q18_;
    Vec dv_q18_;
};

}  // namespace dotpose::core

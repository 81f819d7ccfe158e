// Double-precision version of PlaneFromImage, which maps the image to the code plane.
#pragma once

#include <array>

#include "dotpose/geometry.hpp"

namespace dotpose {

/// PlaneFromImage in double precision:
///
///   plane = at_centre + (du q_u + dv q_v) / (1 + perspective . q + lens q^2)
///
/// where q = pixel - centre_px. The plane point is in spacings.
struct PlaneMap {
    using Vector = std::array<double, 2>;

    explicit constexpr PlaneMap(const PlaneFromImage& fixed)
        : centre_px(scaled(fixed.centre_q8, 0x1p-8)),
          at_centre(scaled(fixed.at_centre_q16, 0x1p-16)),
          du(scaled(fixed.du_q24, 0x1p-24)),
          dv(scaled(fixed.dv_q24, 0x1p-24)),
          perspective(scaled(fixed.perspective_q30, 0x1p-30)),
          lens(fixed.lens_q40 * 0x1p-40) {}

    Vector centre_px;
    Vector at_centre;
    Vector du;
    Vector dv;
    Vector perspective;  ///< per px
    double lens;         ///< per px^2

  private:
    static constexpr Vector scaled(const FixedVec& fixed, double unit) {
        return {fixed.x * unit, fixed.y * unit};
    }
};

}  // namespace dotpose

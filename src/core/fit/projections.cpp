#include "core/fit/projections.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/plane_units.hpp"

namespace dotpose::core {

ScaledPlane::ScaledPlane(const PlaneFromImage& plane, int reach_px)
    : plane_(plane), reach_px_(static_cast<float>(reach_px)) {
    const auto slope = [&](std::int32_t value) {
        return static_cast<float>(value) * reach_px_ / kPower24;
    };
    du_x_ = slope(plane.du_q24.x);
    du_y_ = slope(plane.du_q24.y);
    dv_x_ = slope(plane.dv_q24.x);
    dv_y_ = slope(plane.dv_q24.y);
    tilt_x_ = static_cast<float>(plane.perspective_q30.x) * reach_px_ / kPower30;
    tilt_y_ = static_cast<float>(plane.perspective_q30.y) * reach_px_ / kPower30;
    bend_ = static_cast<float>(plane.lens_q40) * reach_px_ * reach_px_ / kPower40;
}

Projections ScaledPlane::project(FourInts x_q8, FourInts y_q8) const {
    const float unit = 1.0F / (256.0F * reach_px_);
    const Four x = __builtin_convertvector(x_q8, Four) * unit;
    const Four y = __builtin_convertvector(y_q8, Four) * unit;
    const Four r2 = x * x + y * y;
    const Four denominator = 1.0F + tilt_x_ * x + tilt_y_ * y + bend_ * r2;
    const Four divisor = denominator < 0.25F ? Four{} + 0.25F : denominator;
    const Four u = x / divisor;
    const Four v = y / divisor;
    const Four t = r2 / divisor;
    const Four qx = du_x_ * u + dv_x_ * v;
    const Four qy = du_y_ * u + dv_y_ * v;
    return {{qx, qy}, {u, v}, {-qx * u, -qy * u}, {-qx * v, -qy * v}, {-qx * t, -qy * t}};
}

float ScaledPlane::scale() const {
    return std::sqrt((du_x_ * du_x_ + du_y_ * du_y_ + dv_x_ * dv_x_ + dv_y_ * dv_y_) / 2);
}

Parameters ScaledPlane::distortions() const {
    return {0, 0, 0, 0, tilt_x_, tilt_y_, (du_x_ - dv_y_) / 2, (dv_x_ + du_y_) / 2, bend_};
}

PlaneFromImage ScaledPlane::changed(const Parameters& by) const {
    const auto slope = [&](float value) { return rounded(value / reach_px_ * kPower24); };
    PlaneFromImage result = plane_;
    result.at_centre_q16 =
        result.at_centre_q16 + Vec{rounded(by[0] * kPower16), rounded(by[1] * kPower16)};
    result.du_q24 = result.du_q24 + Vec{slope(by[2] + by[6]), slope(by[3] + by[7])};
    result.dv_q24 = result.dv_q24 + Vec{slope(by[7] - by[3]), slope(by[2] - by[6])};
    result.perspective_q30 = {rounded((tilt_x_ + by[4]) / reach_px_ * kPower30),
                              rounded((tilt_y_ + by[5]) / reach_px_ * kPower30)};
    result.lens_q40 = rounded((bend_ + by[8]) / (reach_px_ * reach_px_) * kPower40);
    return result;
}

}  // namespace dotpose::core

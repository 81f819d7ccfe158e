#include "core/fit/projections.hpp"

#include <cmath>

namespace dotpose::core {

std::array<Parameters, 2> jacobian(const FourVecs& places, std::size_t point) {
    const float u = places.x[point];
    const float v = places.y[point];
    const float q = u * u + v * v;
    return {Parameters{1, 0, u, -v, u * u, u * v, u, v, q * u},
            Parameters{0, 1, v, u, u * v, v * v, -v, u, q * v}};
}

ScaledPlane::ScaledPlane(const FloatPlane& plane, float reach_px)
    : plane_(plane),
      reach_px_(reach_px),
      scale_(reach_px * std::sqrt((plane.du_x * plane.du_x + plane.du_y * plane.du_y +
                                   plane.dv_x * plane.dv_x + plane.dv_y * plane.dv_y) /
                                  2)) {}

FourVecs ScaledPlane::project(Four x, Four y) const {
    const FloatPlane& p = plane_;
    const Four divisor = 1.0F + p.tilt_x * x + p.tilt_y * y + p.bend * (x * x + y * y);
    const Four unit = scale_ * (divisor < 0.25F ? Four{} + 0.25F : divisor);
    return {(p.du_x * x + p.dv_x * y) / unit, (p.du_y * x + p.dv_y * y) / unit};
}

Parameters ScaledPlane::distortions() const {
    const FloatPlane& p = plane_;
    const float by = scale_ * scale_ / (p.du_x * p.dv_y - p.dv_x * p.du_y);
    // With points written as complex numbers z, the linear part of the plane is z -> a z + m
    // conj(z). The shear is m / conj(a).
    const float ax = (p.du_x + p.dv_y) / 2;
    const float ay = (p.du_y - p.dv_x) / 2;
    const float mx = (p.du_x - p.dv_y) / 2;
    const float my = (p.du_y + p.dv_x) / 2;
    const float unit = scale_ / (ax * ax + ay * ay);
    return {0,
            0,
            0,
            0,
            (p.du_y * p.tilt_y - p.dv_y * p.tilt_x) * by,
            (p.dv_x * p.tilt_x - p.du_x * p.tilt_y) * by,
            (mx * ax - my * ay) * unit,
            (mx * ay + my * ax) * unit,
            -p.bend * scale_ * reach_px_ * reach_px_};
}

FloatPlane ScaledPlane::changed(const Parameters& by) const {
    const FloatPlane& p = plane_;
    const float unit = 1 / scale_;
    const FloatVec x{1 + (by[2] + by[6]) * unit, (by[7] + by[3]) * unit};
    const FloatVec y{(by[7] - by[3]) * unit, 1 + (by[2] - by[6]) * unit};
    const float tilt_x = by[4] * unit * unit;
    const float tilt_y = by[5] * unit * unit;
    return {p.at_x + by[0],
            p.at_y + by[1],
            x.x * p.du_x + y.x * p.du_y,
            x.y * p.du_x + y.y * p.du_y,
            x.x * p.dv_x + y.x * p.dv_y,
            x.y * p.dv_x + y.y * p.dv_y,
            p.tilt_x - (tilt_x * p.du_x + tilt_y * p.du_y),
            p.tilt_y - (tilt_x * p.dv_x + tilt_y * p.dv_y),
            p.bend - by[8] * unit / (reach_px_ * reach_px_)};
}

}  // namespace dotpose::core

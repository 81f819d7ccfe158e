#include "core/fit/plane_normal.hpp"

#include <cstring>

namespace dotpose::core {

void PlaneSums::add(const FourVecs& places, const Residuals& residuals) {
    const auto& [u, v] = places;
    const auto& [x, y] = residuals.offset;
    const Four w = residuals.weight;
    less_points_ += w > 0.0F;
    const Four q = u * u + v * v;
    const Four wu = w * u;
    const Four wv = w * v;
    const Four uu = wu * u;
    const Four uv = wu * v;
    const Four vv = wv * v;
    add_each(places_[0], w, wu, wv, uu);
    add_each(places_[1], uv, vv, uu * u, uu * v);
    add_each(places_[2], vv * u, vv * v, q * uu, q * uv);
    add_each(places_[3], q * vv, q * q * wu, q * q * wv, q * q * (uu + vv));
    const Four a = x * wu + y * wv;
    add_each(residuals_[0], w * x, w * y, x * wu, y * wv);
    add_each(residuals_[1], y * wu, x * wv, a * u, a * v);
    add_each(residuals_[2], a * q, w * (x * x + y * y), Four{}, Four{});
}

FitSums PlaneSums::all() const {
    FitSums sums;
    for (int i = 0; i < 4; ++i)
        sums.points -= less_points_[i];
    std::memcpy(sums.places.data(), places_.data(), sizeof sums.places);
    std::memcpy(sums.residuals.data(), residuals_.data(), sizeof sums.residuals);
    sums.squares = residuals_[2][1];
    return sums;
}

PlaneNormal::PlaneNormal(const FitSums& sums)
    : squared_residuals_(sums.squares), points_(sums.points) {
    const auto& [n, u, v, uu, uv, vv, uuu, uuv, uvv, vvv, quu, quv, qvv, qqu, qqv, qqq] =
        sums.places;
    const float qu = uuu + uvv;
    const float qv = uuv + vvv;
    const float q = uu + vv;
    const std::array<Parameters, kPoseParameters> lower{
        {{n},
         {0, n},
         {u, v, q},
         {-v, u, 0, q},
         {uu, uv, qu, 0, quu},
         {uv, vv, qv, 0, quv, qvv},
         {u, -v, uu - vv, -2 * uv, uuu - uvv, uuv - vvv, q},
         {v, u, 2 * uv, uu - vv, 2 * uuv, 2 * uvv, 0, q},
         {qu, qv, quu + qvv, 0, qqu, qqv, quu - qvv, 2 * quv, qqq}}};
    for (std::size_t row = 0; row < kPoseParameters; ++row) {
        for (std::size_t column = 0; column <= row; ++column)
            set(row, column, lower[row][column]);
    }
    const auto& [x, y, xu, yv, yu, xv, au, av, aq] = sums.residuals;
    set_right({x, y, xu + yv, yu - xv, au, av, xu - yv, xv + yu, aq});
}

}  // namespace dotpose::core

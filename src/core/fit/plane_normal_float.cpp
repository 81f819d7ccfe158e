#include "core/fit/plane_normal_float.hpp"

#include <cmath>

namespace dotpose::core {

void PlaneSumsFloat::add(const Projections& projections, const Residuals& residuals) {
    const auto& [u, v] = projections.scale;
    const auto& [ax, ay] = projections.tilt_x;
    const auto& [bx, by] = projections.tilt_y;
    const auto& [cx, cy] = projections.bend;
    const auto& [rx, ry] = residuals.off;
    const Four w = residuals.weight;
    less_points_ += w > 0.0F;
    // In each product the weight is multiplied into one of the two factors.
    const Four wu = w * u;
    const Four wv = w * v;
    const Four wax = w * ax;
    const Four way = w * ay;
    const Four wbx = w * bx;
    const Four wby = w * by;
    const Four wcx = w * cx;
    const Four wcy = w * cy;
    add_each(one_scale_square_, w, wu, wv, w * (rx * rx + ry * ry));
    add_each(tilts_, wax, way, wbx, wby);
    add_each(bend_off_, wcx, wcy, w * rx, w * ry);
    add_each(scale_turned_, wu * u + wv * v, wv * u - wu * v, wu * u - wv * v, wu * v + wv * u);
    add_each(tilt_x_turned_, wax * u + way * v, way * u - wax * v, ax * wu - ay * wv,
             ax * wv + ay * wu);
    add_each(tilt_y_turned_, wbx * u + wby * v, wby * u - wbx * v, bx * wu - by * wv,
             bx * wv + by * wu);
    add_each(bend_turned_, wcx * u + wcy * v, wcy * u - wcx * v, wcx * u - wcy * v,
             wcx * v + wcy * u);
    add_each(off_turned_, rx * wu + ry * wv, ry * wu - rx * wv, rx * wu - ry * wv,
             rx * wv + ry * wu);
    add_each(tilt_tilt_, wax * ax + way * ay, wbx * ax + wby * ay, wbx * bx + wby * by, Four{});
    add_each(bend_further_, wcx * ax + wcy * ay, wcx * bx + wcy * by, wcx * cx + wcy * cy, Four{});
    add_each(off_further_, wax * rx + way * ry, wbx * rx + wby * ry, wcx * rx + wcy * ry, Four{});
}

PlaneNormalFloat::PlaneNormalFloat(const PlaneSumsFloat& sum)
    : squared_residuals_(sum.one_scale_square_[3]) {
    for (int i = 0; i < 4; ++i)
        points_ -= sum.less_points_[i];
    const float one = sum.one_scale_square_[0];
    const float u = sum.one_scale_square_[1];
    const float v = sum.one_scale_square_[2];
    const Four& a = sum.tilts_;
    const Four& c = sum.bend_off_;
    const Four& z = sum.scale_turned_;
    const Four& az = sum.tilt_x_turned_;
    const Four& bz = sum.tilt_y_turned_;
    const Four& cz = sum.bend_turned_;
    const Four& rz = sum.off_turned_;
    const Four& t = sum.tilt_tilt_;
    const Four& ca = sum.bend_further_;
    const Four& ra = sum.off_further_;
    m_ = {{{one},
           {0, one},
           {u, v, z[0]},
           {-v, u, -z[1], z[0]},
           {a[0], a[1], az[0], az[1], t[0]},
           {a[2], a[3], bz[0], bz[1], t[1], t[2]},
           {u, -v, z[2], -z[3], az[2], bz[2], z[0]},
           {v, u, z[3], z[2], az[3], bz[3], z[1], z[0]},
           {c[0], c[1], cz[0], cz[1], ca[0], ca[1], cz[2], cz[3], ca[2]}}};
    right_ = {c[2], c[3], rz[0], rz[1], ra[0], ra[1], rz[2], rz[3], ra[2]};
}

PlaneNormalFloat::PlaneNormalFloat(const FitSums& sums)
    : m_(sums.matrix),
      right_(sums.right),
      squared_residuals_(sums.squared_residuals),
      points_(static_cast<int>(sums.points)) {}

bool PlaneNormalFloat::decompose() {
    // The part of a diagonal element that must be left after elimination of the parameters before
    // it, for its parameter to count as determined.
    constexpr float kDetermined = 1e-4F;
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        if (i >= 4 && m_[i][i] <= 0) {  // The caller did not ask for this parameter.
            m_[i].fill(0);
            continue;
        }
        const float least = kDetermined * m_[i][i];
        for (std::size_t j = 0; j <= i; ++j) {
            float sum = m_[i][j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= m_[i][k] * m_[j][k];
            if (i != j) {
                m_[i][j] = determines(j) ? sum / m_[j][j] : 0;
            } else if (sum > least) {
                m_[i][i] = std::sqrt(sum);
            } else if (i < 4) {
                return false;
            } else {
                m_[i].fill(0);
            }
        }
    }
    return true;
}

Parameters PlaneNormalFloat::whitened(Parameters column) const {
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        if (!determines(i)) {
            column[i] = 0;
            continue;
        }
        for (std::size_t k = 0; k < i; ++k)
            column[i] -= m_[i][k] * column[k];
        column[i] /= m_[i][i];
    }
    return column;
}

Parameters PlaneNormalFloat::unwhitened(Parameters column) const {
    for (std::size_t i = kPoseParameters; i-- > 0;) {
        if (!determines(i)) {
            column[i] = 0;
            continue;
        }
        for (std::size_t k = i + 1; k < kPoseParameters; ++k)
            column[i] -= m_[k][i] * column[k];
        column[i] /= m_[i][i];
    }
    return column;
}

Parameters PlaneNormalFloat::times_transposed(const Parameters& column) const {
    Parameters result{};
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        for (std::size_t k = i; k < kPoseParameters; ++k)
            result[i] += m_[k][i] * column[k];
    }
    return result;
}

}  // namespace dotpose::core

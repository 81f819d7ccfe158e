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
    set_rows({{{one},
               {0, one},
               {u, v, z[0]},
               {-v, u, -z[1], z[0]},
               {a[0], a[1], az[0], az[1], t[0]},
               {a[2], a[3], bz[0], bz[1], t[1], t[2]},
               {u, -v, z[2], -z[3], az[2], bz[2], z[0]},
               {v, u, z[3], z[2], az[3], bz[3], z[1], z[0]},
               {c[0], c[1], cz[0], cz[1], ca[0], ca[1], cz[2], cz[3], ca[2]}}});
    right_ = {c[2], c[3], rz[0], rz[1], ra[0], ra[1], rz[2], rz[3], ra[2]};
}

PlaneNormalFloat::PlaneNormalFloat(const FitSums& sums)
    : right_(sums.right),
      squared_residuals_(sums.squared_residuals),
      points_(static_cast<int>(sums.points)) {
    set_rows(sums.matrix);
}

void PlaneNormalFloat::set_rows(const std::array<Parameters, kPoseParameters>& lower) {
    for (std::size_t row = 0; row < kPoseParameters; ++row) {
        for (std::size_t column = 0; column <= row; ++column)
            m_[column].set(row, lower[row][column]);
    }
}

void PlaneNormalFloat::leave_out(std::size_t parameter) {
    for (std::size_t i = 0; i < parameter; ++i)
        m_[i].set(parameter, 0);
    m_[parameter] = {};
}

bool PlaneNormalFloat::decompose() {
    // The part of a diagonal element that must be left after elimination of the parameters before
    // it, for its parameter to count as determined.
    constexpr float kDetermined = 1e-4F;
    Parameters least;
    for (std::size_t i = 0; i < kPoseParameters; ++i)
        least[i] = kDetermined * m_[i].at(i);
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        Column& column = m_[i];
        // This also leaves out parameters that the caller did not ask for, whose element is 0.
        if (!(column.at(i) > least[i])) {
            if (i < 4) return false;
            leave_out(i);
            continue;
        }
        const float root = std::sqrt(column.at(i));
        column.divide(root);
        column.set(i, root);
        column.clear_before(i);
        for (std::size_t k = i + 1; k < kPoseParameters; ++k)
            m_[k].subtract(column, column.at(k));
    }
    return true;
}

Parameters PlaneNormalFloat::whitened(const Parameters& of) const {
    Column rest(of);
    Parameters result;
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        result[i] = determines(i) ? rest.at(i) / m_[i].at(i) : 0;
        rest.subtract(m_[i], result[i]);
    }
    return result;
}

Parameters PlaneNormalFloat::unwhitened(const Parameters& column) const {
    // Each number waits for the one before it, so that comes last into the sum.
    Parameters result{};
    for (std::size_t i = kPoseParameters; i-- > 0;) {
        float rest = column[i];
        for (std::size_t k = kPoseParameters; --k > i;)
            rest -= m_[i].at(k) * result[k];
        result[i] = determines(i) ? rest / m_[i].at(i) : 0;
    }
    return result;
}

Parameters PlaneNormalFloat::times_transposed(const Parameters& column) const {
    const Column other(column);
    Parameters result;
    for (std::size_t i = 0; i < kPoseParameters; ++i)
        result[i] = m_[i].inner(other);
    return result;
}

}  // namespace dotpose::core

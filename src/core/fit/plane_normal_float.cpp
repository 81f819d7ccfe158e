#include "core/fit/plane_normal_float.hpp"

#include <cmath>

namespace dotpose::core {

void PlaneSumsFloat::add(const FourVecs& places, const Residuals& residuals) {
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

FitSums PlaneSumsFloat::all() const {
    FitSums sums;
    for (int i = 0; i < 4; ++i)
        sums.points -= less_points_[i];
    std::memcpy(sums.places.data(), places_.data(), sizeof sums.places);
    std::memcpy(sums.residuals.data(), residuals_.data(), sizeof sums.residuals);
    sums.squares = residuals_[2][1];
    return sums;
}

PlaneNormalFloat::PlaneNormalFloat(const FitSums& sums)
    : squared_residuals_(sums.squares), points_(sums.points) {
    const auto& [n, u, v, uu, uv, vv, uuu, uuv, uvv, vvv, quu, quv, qvv, qqu, qqv, qqq] =
        sums.places;
    const float qu = uuu + uvv;
    const float qv = uuv + vvv;
    const float q = uu + vv;
    set_rows({{{n},
               {0, n},
               {u, v, q},
               {-v, u, 0, q},
               {uu, uv, qu, 0, quu},
               {uv, vv, qv, 0, quv, qvv},
               {u, -v, uu - vv, -2 * uv, uuu - uvv, uuv - vvv, q},
               {v, u, 2 * uv, uu - vv, 2 * uuv, 2 * uvv, 0, q},
               {qu, qv, quu + qvv, 0, qqu, qqv, quu - qvv, 2 * quv, qqq}}});
    const auto& [x, y, xu, yv, yu, xv, au, av, aq] = sums.residuals;
    right_ = {x, y, xu + yv, yu - xv, au, av, xu - yv, xv + yu, aq};
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
    // Minimum fraction of a diagonal element that must remain after the elimination of the
    // preceding parameters. If less remains, the points do not determine the parameter.
    constexpr float kDetermined = 1e-4F;
    Parameters minima;
    for (std::size_t i = 0; i < kPoseParameters; ++i)
        minima[i] = kDetermined * m_[i].at(i);
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        Column& column = m_[i];
        // Parameters that the caller did not add have a diagonal element of 0 and are left out as
        // well.
        if (!(column.at(i) > minima[i])) {
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
    // Each element depends on the element computed just before it, which is therefore subtracted
    // last.
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

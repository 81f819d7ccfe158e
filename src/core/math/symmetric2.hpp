// Symmetric2: symmetric systems of two linear equations, as in least squares with two unknowns.
#pragma once

#include <array>

namespace dotpose::core {

/// A symmetric 2 x 2 matrix. Products of two elements must not overflow.
template <typename Number>
struct Symmetric2 {
    Number xx;
    Number xy;
    Number yy;

    constexpr Number determinant() const { return xx * yy - xy * xy; }
    /// Solves matrix * solution = (x, y) by Cramer's rule. Returns the solution times the
    /// determinant.
    constexpr std::array<Number, 2> solve_scaled(Number x, Number y) const {
        return {x * yy - y * xy, y * xx - x * xy};
    }
    constexpr Symmetric2 inverse() const {
        const Number d = determinant();
        return {yy / d, -xy / d, xx / d};
    }
    constexpr std::array<Number, 2> operator*(const std::array<Number, 2>& v) const {
        return {xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]};
    }
};

}  // namespace dotpose::core

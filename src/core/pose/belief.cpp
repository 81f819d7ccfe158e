#include "core/pose/belief.hpp"

#include <algorithm>
#include <cmath>

#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

using Pair = std::array<float, 2>;

/// A symmetric matrix.
struct Symmetric {
    float xx;
    float xy;
    float yy;

    float determinant() const { return xx * yy - xy * xy; }
    Symmetric inverse() const {
        const float d = determinant();
        return {yy / d, -xy / d, xx / d};
    }
    Pair operator*(const Pair& v) const { return {xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]}; }
};

/// Of the whitened terms, in units of the noise's variance, if the terms' own were 1.
Symmetric spread_of(const Terms& terms, const Normal& normal, float variance) {
    const std::size_t i = terms.first;
    const float scale = 1 / variance;
    const float a = normal.factor(i, i);
    if (terms.count == 1) return {a * a * scale, 0, 0};
    const float b = normal.factor(i + 1, i);
    const float c = normal.factor(i + 1, i + 1);
    return {(a * a + b * b) * scale, b * c * scale, c * c * scale};
}

/// 2^log2, for log2 <= 0.
float power_of_two(float log2) {
    constexpr float kLeast = -60;
    const auto log2_q8 = static_cast<int>(std::max(log2, kLeast) * 256);
    const int whole = log2_q8 >> 8;
    return std::ldexp(static_cast<float>(exp2_q16(log2_q8 - whole * 256)), whole - 16);
}

}  // namespace

Belief belief_in(const Terms& terms, const Normal& normal, const Parameters& whitened,
                 float variance, float unit) {
    constexpr std::size_t kKinds = 3;
    const Pair seen{whitened[terms.first], terms.count > 1 ? whitened[terms.first + 1] : 0.0F};
    const Symmetric spread = spread_of(terms, normal, variance);
    // Of the noise and of the terms together, inverse, for each kind.
    std::array<Symmetric, kKinds> precision;
    std::array<float, kKinds> distance;
    for (std::size_t k = 0; k < kKinds; ++k) {
        const float deviation = terms.kinds[k].deviation * unit;
        const float own = deviation * deviation;
        precision[k] =
            Symmetric{1 + own * spread.xx, own * spread.xy, 1 + own * spread.yy}.inverse();
        const Pair p = precision[k] * seen;
        distance[k] = (p[0] * seen[0] + p[1] * seen[1]) / variance;
    }
    const float nearest = *std::min_element(distance.begin(), distance.end());
    std::array<float, kKinds> share;
    float sum = 0;
    for (std::size_t k = 0; k < kKinds; ++k) {
        constexpr float kHalfLog2OfE = 0.7213475F;
        share[k] = terms.kinds[k].probability * std::sqrt(precision[k].determinant()) *
                   power_of_two((nearest - distance[k]) * kHalfLog2OfE);
        sum += share[k];
    }
    Belief belief{};
    std::array<Pair, kKinds> means;
    for (std::size_t k = 0; k < kKinds; ++k) {
        share[k] /= sum;
        // Each kind keeps 1 - precision of what is seen.
        const Pair lost = precision[k] * seen;
        means[k] = {seen[0] - lost[0], seen[1] - lost[1]};
        for (std::size_t i = 0; i < 2; ++i)
            belief.mean[i] += share[k] * means[k][i];
    }
    for (std::size_t k = 0; k < kKinds; ++k) {
        const Pair off{means[k][0] - belief.mean[0], means[k][1] - belief.mean[1]};
        const std::array<Pair, 2> kept{Pair{1 - precision[k].xx, -precision[k].xy},
                                       Pair{-precision[k].xy, 1 - precision[k].yy}};
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t j = 0; j < 2; ++j)
                belief.covariance[i][j] += share[k] * (variance * kept[i][j] + off[i] * off[j]);
        }
    }
    return belief;
}

}  // namespace dotpose::core

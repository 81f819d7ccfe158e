#include "core/fit/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/math/exponential.hpp"
#include "core/math/symmetric2.hpp"

namespace dotpose::core {
namespace {

using Pair = std::array<float, 2>;

using Symmetric = Symmetric2<float>;

/// Returns L^T L / `variance` for the given terms, where L is the factor in `normal`. If the terms
/// are independent and have a variance of 1, this is the covariance of the whitened terms, in units
/// of the noise variance.
Symmetric spread_of(const DistortionPrior& terms, const PlaneNormal& normal, float variance) {
    const std::size_t i = terms.first;
    const float scale = 1 / variance;
    const float a = normal.factor(i, i);
    if (terms.count == 1) return {a * a * scale, 0, 0};
    const float b = normal.factor(i + 1, i);
    const float c = normal.factor(i + 1, i + 1);
    return {(a * a + b * b) * scale, b * c * scale, c * c * scale};
}

/// Posterior for one component of the prior.
struct PosteriorOfKind {
    /// Inverse covariance of the whitened fitted terms, times the noise variance. The covariance is
    /// the sum of the prior covariance and the noise covariance.
    Symmetric precision;
    Pair mean;
    float distance;  ///< squared Mahalanobis distance of the fitted terms from 0
    /// Prior probability of the component. `weigh` replaces it with the posterior probability.
    float probability;

    PosteriorOfKind() = default;
    PosteriorOfKind(const DistortionPrior::Kind& kind, const Symmetric& spread, const Pair& seen,
                    float variance, float unit) {
        const float own = kind.deviation * unit * kind.deviation * unit;
        precision = Symmetric{1 + own * spread.xx, own * spread.xy, 1 + own * spread.yy}.inverse();
        const Pair lost = precision * seen;
        mean = {seen[0] - lost[0], seen[1] - lost[1]};
        distance = (lost[0] * seen[0] + lost[1] * seen[1]) / variance;
        probability = kind.probability;
    }
};
using PosteriorsByKind =
    std::array<PosteriorOfKind, std::tuple_size_v<decltype(DistortionPrior::kinds)>>;

/// Replaces the prior probabilities of the components with their posterior probabilities.
void weigh(PosteriorsByKind& kinds) {
    float nearest = kinds[0].distance;
    for (const PosteriorOfKind& kind : kinds)
        nearest = std::min(nearest, kind.distance);
    float sum = 0;
    for (PosteriorOfKind& kind : kinds) {
        kind.probability *=
            std::sqrt(kind.precision.determinant()) * natural_exp((nearest - kind.distance) / 2);
        sum += kind.probability;
    }
    for (PosteriorOfKind& kind : kinds)
        kind.probability /= sum;
}

/// Returns the posterior of the mixture. Its covariance is the mean of the component covariances
/// plus the covariance of the component means.
Posterior mixed(const PosteriorsByKind& kinds, float variance) {
    Posterior posterior{};
    for (const PosteriorOfKind& kind : kinds) {
        for (std::size_t i = 0; i < 2; ++i)
            posterior.mean[i] += kind.probability * kind.mean[i];
    }
    for (const PosteriorOfKind& kind : kinds) {
        const Symmetric& precision = kind.precision;
        const std::array<Pair, 2> kept{Pair{1 - precision.xx, -precision.xy},
                                       Pair{-precision.xy, 1 - precision.yy}};
        const Pair off{kind.mean[0] - posterior.mean[0], kind.mean[1] - posterior.mean[1]};
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t j = 0; j < 2; ++j)
                posterior.covariance[i][j] +=
                    kind.probability * (variance * kept[i][j] + off[i] * off[j]);
        }
    }
    return posterior;
}

}  // namespace

Posterior posterior_of(const DistortionPrior& terms, const PlaneNormal& normal,
                       const Parameters& whitened, float variance, float unit) {
    const Pair seen{whitened[terms.first], terms.count > 1 ? whitened[terms.first + 1] : 0.0F};
    const Symmetric spread = spread_of(terms, normal, variance);
    PosteriorsByKind kinds;
    for (std::size_t k = 0; k < kinds.size(); ++k)
        kinds[k] = PosteriorOfKind(terms.kinds[k], spread, seen, variance, unit);
    weigh(kinds);
    return mixed(kinds, variance);
}

}  // namespace dotpose::core

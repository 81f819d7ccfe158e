// Posterior: Bayesian shrinkage of the fitted distortion terms towards 0. The terms are 0 if a
// camera without lens distortion looks straight at flat paper. The pose is less accurate if a
// nonexistent distortion is fitted or if a real distortion is ignored, so the shrinkage depends on
// the probability of distortion. Unlike the paper, dotpose fits these terms.
#pragma once

#include <array>
#include <cstddef>

#include "core/fit/plane_normal.hpp"

namespace dotpose::core {

/// Prior for one or two distortion terms that occur together: a mixture of three zero-mean
/// Gaussians.
struct DistortionPrior {
    struct Kind {
        float probability;
        /// Standard deviation of each term, relative to the `unit` passed to `posterior_of`.
        float deviation;
    };
    std::size_t first;  ///< index of the first term in `Parameters`
    std::size_t count;  ///< number of terms, 1 or 2
    std::array<Kind, 3> kinds;
};

/// Posterior mean and covariance of the whitened terms (see `posterior_of`), given the dots in one
/// frame. If there is only one term, all second elements are 0.
struct Posterior {
    std::array<float, 2> mean;
    std::array<std::array<float, 2>, 2> covariance;
};

/// Computes the posterior by Bayes' rule. `whitened` is L^T times the vector of all fitted terms,
/// where L is the Cholesky factor in `normal`. `variance` is the noise variance of each element of
/// `whitened`. `unit` is the unit of the standard deviations in the prior.
Posterior posterior_of(const DistortionPrior& terms, const PlaneNormal& normal,
                       const Parameters& whitened, float variance, float unit);

}  // namespace dotpose::core

// Posterior: estimates the distortion terms with Bayes' rule, which shrinks the fitted terms
// towards 0. The terms are 0 for a camera that looks straight at flat paper. Fitting a tilt that is
// not present costs accuracy, as does omitting a tilt that is present. The amount of shrinkage
// depends on the probability that a tilt is present. Differs: the paper has no such terms.
#pragma once

#include <array>
#include <cstddef>

#include "core/fit/plane_normal.hpp"

namespace dotpose::core {

/// Prior of one or two distortion terms that occur together: a mixture of three Gaussians with mean
/// 0.
struct DistortionPrior {
    struct Kind {
        float probability;
        float deviation;  ///< standard deviation of each term, relative to `unit` of `posterior_of`
    };
    std::size_t first;  ///< index of the first term in `Parameters`
    std::size_t count;  ///< number of terms, 1 or 2
    std::array<Kind, 3> kinds;
};

/// Posterior of the whitened terms, given the dots of one frame. The second term is 0 if there is
/// only one term.
struct Posterior {
    std::array<float, 2> mean;
    std::array<std::array<float, 2>, 2> covariance;
};

/// Computes the posterior with Bayes' rule. `whitened` contains the fitted terms times L^T, where L
/// is the Cholesky factor of `normal`. `variance` is the noise variance of each element of
/// `whitened`. `unit` is the unit of the standard deviations of the prior.
Posterior posterior_of(const DistortionPrior& terms, const PlaneNormal& normal,
                       const Parameters& whitened, float variance, float unit);

}  // namespace dotpose::core

// Posterior: shrinkage of the distortion terms, which a camera straight above flat paper does not
// need. Fitting a tilt that is not there costs accuracy, and so does omitting one that is. The
// shrinkage depends on their probabilities. differs: the paper has no such terms.
#pragma once

#include <array>
#include <cstddef>

#include "core/fit/plane_normal.hpp"

namespace dotpose::core {

/// Prior of one or two distortion terms that occur together: a mixture of three Gaussians about 0.
struct DistortionPrior {
    struct Kind {
        float probability;
        float deviation;  ///< standard deviation of each term, in `unit` of `posterior_of`
    };
    std::size_t first;  ///< index of the first term in `Parameters`
    std::size_t count;  ///< number of terms, 1 or 2
    std::array<Kind, 3> kinds;
};

/// Posterior of whitened terms, given one frame. The second term is 0 if there is only one.
struct Posterior {
    std::array<float, 2> mean;
    std::array<std::array<float, 2>, 2> covariance;
};

/// Returns the posterior by Bayes' rule. `whitened` are the terms as fitted, from
/// normal.times_transposed. `variance` is the variance of each of their elements, `unit` the unit
/// of the standard deviations of the prior.
Posterior posterior_of(const DistortionPrior& terms, const PlaneNormal& normal,
                       const Parameters& whitened, float variance, float unit);

}  // namespace dotpose::core

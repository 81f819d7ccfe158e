// Posterior: how much to keep of terms that a camera straight above flat paper would not need
// (shrinkage). Fitting a tilt where there is none costs accuracy, and so does leaving one out; how
// likely each is decides. differs: the paper has no such terms.
#pragma once

#include <array>
#include <cstddef>

#include "core/fit/plane_normal_float.hpp"

namespace dotpose::core {

/// One or two terms that occur together, and their prior: one of three kinds, each a Gaussian about
/// 0.
struct FurtherTerms {
    struct Kind {
        float probability;
        float deviation;  ///< of each term, in `unit` of `posterior_of`
    };
    std::size_t first;  ///< index of the first one in Parameters
    std::size_t count;  ///< at most 2
    std::array<Kind, 3> kinds;
};

/// The posterior of whitened terms, given one frame. The second term is 0 if there is only one.
struct Posterior {
    std::array<float, 2> mean;
    std::array<std::array<float, 2>, 2> covariance;
};

/// Returns the posterior by Bayes' rule. `whitened` are the terms as fitted, from
/// normal.times_transposed; `variance` is that of each of its elements; `unit` is that of the
/// kinds' deviations.
Posterior posterior_of(const FurtherTerms& terms, const PlaneNormalFloat& normal,
                       const Parameters& whitened, float variance, float unit);

}  // namespace dotpose::core

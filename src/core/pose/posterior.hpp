// Posterior: how much of a term to keep that a plain camera would not need. Fitting a tilt where
// there is none costs accuracy, and so does leaving one out; how likely each is decides. differs:
// the paper has no such terms.
#pragma once

#include <array>
#include <cstddef>

#include "core/fit/plane_normal_float.hpp"

namespace dotpose::core {

/// Terms that come and go together, and what is thought of them before a frame is seen: that they
/// are of one of three kinds, each drawn from a Gaussian.
struct FurtherTerms {
    struct Kind {
        float probability;
        float deviation;  ///< of each term
    };
    std::size_t first;  ///< of the parameters
    std::size_t count;  ///< at most 2
    std::array<Kind, 3> kinds;
};

/// What a frame makes of them, for whitened terms: mean and covariance.
struct Posterior {
    std::array<float, 2> mean;
    std::array<std::array<float, 2>, 2> covariance;
};

/// By the rule of Bayes. `whitened`: the terms as fitted, from normal.times_transposed; `variance`
/// is that of each element of it; `unit` that in which the deviations are given.
Posterior posterior_of(const FurtherTerms& terms, const PlaneNormalFloat& normal,
                       const Parameters& whitened, float variance, float unit);

}  // namespace dotpose::core

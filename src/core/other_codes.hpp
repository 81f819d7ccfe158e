// Other codes: how well the bits of a frame agree with profiles other than the one it was read in.
// The attempts fill it in; `locate_in_any_code` evaluates it.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Likelihood ratios of another profile along one axis, against the place read; 1: equally likely.
struct OtherAxis {
    float here = 1;       ///< likelihood ratio of the same place in the other profile
    float elsewhere = 0;  ///< upper bound of the sum of those of all its other places
    float best = 0;       ///< likelihood ratio of the likeliest of these, among those examined
    std::uint32_t position = 0;  ///< position of the first line at that likeliest place
    std::uint8_t roll = 0;  ///< amount by which the roll of its first line is larger than the one
                            ///< read
};

/// Likelihood ratios of one other profile along both axes.
struct OtherCode {
    OtherAxis x;
    OtherAxis y;

    /// Likelihood ratio of the same place by both axes.
    float here() const { return x.here * y.here; }
    /// Sum of the likelihood ratios of all other places.
    float elsewhere() const { return x.here * y.elsewhere + x.elsewhere * (y.here + y.elsewhere); }
};

/// The likelihood ratios of all other profiles.
struct OtherCodes {
    bool are_wanted = false;
    /// Value of `log2_in_question_q8` if the profile is given.
    static constexpr int kNoneInQuestion = -1;
    /// log2 of the number of profiles that are possible, each weighted by its odds, in 2^-8.
    int log2_in_question_q8 = 0;
    /// Positions, in the profile read, of the first column and row that were compared.
    Cell first;
    std::array<OtherCode, kProfileCount> of;  ///< by profile; the entry of the profile read is not
                                              ///< used
};

}  // namespace dotpose::core

// Other codes: agreement of the bits of a frame with the code variants other than the variant that
// was read. The attempts compute the agreement, and `Locator` evaluates it.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Likelihood ratios of the places in another code variant along one axis, relative to the place
/// that was read. A place with the ratio 1 is as likely as the place that was read.
struct OtherAxis {
    float here = 1;  ///< likelihood ratio of the same place in the other variant
    /// Upper bound on the sum of the likelihood ratios of all other places in that variant.
    float elsewhere = 0;
    float best = 0;              ///< largest likelihood ratio among the other places examined
    std::uint32_t position = 0;  ///< position of the first line at the place of `best`
    std::uint8_t roll = 0;       ///< roll of the first line at that place minus the roll read
};

/// Likelihood ratios of one other code variant along both axes.
struct OtherCode {
    OtherAxis x;
    OtherAxis y;

    /// Returns the likelihood ratio of the same place, for both axes together.
    float here() const { return x.here * y.here; }
    /// Returns an upper bound on the sum of the likelihood ratios of all other places, for both
    /// axes together.
    float elsewhere() const { return x.here * y.elsewhere + x.elsewhere * (y.here + y.elsewhere); }
};

/// The likelihood ratios of all other code variants.
struct OtherCodes {
    bool are_wanted = false;
    /// Value of `log2_in_question_q8` if the code variant is given.
    static constexpr int kNoneInQuestion = -1;
    /// Upper bound on log2 of the number of possible code variants, each weighted by its odds
    /// relative to the variant that was read, in units of 2^-8.
    int log2_in_question_q8 = 0;
    /// Positions of the first compared column and of the first compared row, in the code variant
    /// that was read.
    Cell first;
    std::array<OtherCode, kCodeVariantCount>
        of;  ///< indexed by code variant; the entry of the variant that was read is unused
};

}  // namespace dotpose::core

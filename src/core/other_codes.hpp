// Other codes: agreement of the bits of a frame with code variants other than the variant read. The
// attempts compute the agreement, and `Locator` evaluates it.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Likelihood ratios of another code variant along one axis, relative to the place read. A ratio of
/// 1 means equally likely.
struct OtherAxis {
    float here = 1;  ///< likelihood ratio of the place of the reading in the other variant
    /// Upper bound on the sum of the likelihood ratios of all other places in that variant.
    float elsewhere = 0;
    float best = 0;  ///< largest likelihood ratio of another place, among the places examined
    std::uint32_t position = 0;  ///< position of the first line at the place of `best`
    std::uint8_t roll = 0;       ///< roll of the first line at that place minus the roll read
};

/// Likelihood ratios of one other code variant along both axes.
struct OtherCode {
    OtherAxis x;
    OtherAxis y;

    /// Returns the likelihood ratio of the place of the reading, over both axes.
    float here() const { return x.here * y.here; }
    /// Returns an upper bound on the sum of the likelihood ratios of all other places, over both
    /// axes.
    float elsewhere() const { return x.here * y.elsewhere + x.elsewhere * (y.here + y.elsewhere); }
};

/// The likelihood ratios of all other code variants.
struct OtherCodes {
    bool are_wanted = false;
    /// Value of `log2_in_question_q8` if the code variant is given.
    static constexpr int kNoneInQuestion = -1;
    /// Upper bound on log2 of the number of possible code variants, each weighted by its odds
    /// relative to the variant read, in units of 2^-8.
    int log2_in_question_q8 = 0;
    /// First compared column and row, as positions in the code variant that was read.
    Cell first;
    std::array<OtherCode, kCodeVariantCount>
        of;  ///< by code variant; the entry of the variant read is not used
};

}  // namespace dotpose::core

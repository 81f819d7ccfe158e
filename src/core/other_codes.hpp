// Other codes: the agreement of a frame with each code other than the one that was read. The
// attempts compute this agreement, and `Locator` compares the codes.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Likelihood ratios in another code, along one axis. A ratio is the likelihood of a place in the
/// other code divided by the likelihood of the place that was read.
struct OtherAxis {
    float here = 1;  ///< ratio for the same place in the other code
    /// Upper bound on the summed ratios of all other places.
    float elsewhere = 0;
    /// Largest ratio among the examined places, excluding the place that was read.
    float best = 0;
    /// Position of the first compared line if the place with ratio `best` is correct.
    std::uint32_t position = 0;
    /// Roll of the first compared line if the place with ratio `best` is correct, minus the roll
    /// that was read for this line, modulo 63.
    std::uint8_t roll = 0;
};

/// Likelihood ratios in one other code, along both axes.
struct OtherCode {
    OtherAxis x;
    OtherAxis y;

    /// Returns the likelihood ratio for the same place in the other code: the product over both
    /// axes.
    float here() const { return x.here * y.here; }
    /// Returns an upper bound on the summed likelihood ratios of all other places. The ratio of a
    /// place is the product of its ratios along both axes.
    float elsewhere() const { return x.here * y.elsewhere + x.elsewhere * (y.here + y.elsewhere); }
};

/// Likelihood ratios in all other codes.
struct OtherCodes {
    bool are_wanted = false;
    /// Value of `log2_in_question_q8` if the caller specifies the code.
    static constexpr int kNoneInQuestion = -1;
    /// Upper bound on the weighted number of possible codes, as log2 in units of 2^-8. The weight
    /// of a code is its odds relative to the code that was read.
    int log2_in_question_q8 = 0;
    /// Positions of the first compared column and row, in the code that was read.
    Cell first;
    /// Indexed by code. The entry for the code that was read is unused.
    std::array<OtherCode, kCodeVariantCount> of;
};

}  // namespace dotpose::core

// Other codes: how well a frame agrees with each code variant except the one that was read. The
// attempts compute this agreement, and `Locator` evaluates it.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Likelihood ratios in another code variant, along one axis. They are relative to the place that
/// was read, so a place with ratio 1 is equally likely.
struct OtherAxis {
    float here = 1;  ///< ratio of the same place
    /// Upper bound on the summed ratios of all different places.
    float elsewhere = 0;
    float best = 0;              ///< largest ratio of a different place, among the places examined
    std::uint32_t position = 0;  ///< position of the first line at the place of `best`
    std::uint8_t roll = 0;       ///< roll of that line, minus the roll that was read
};

/// Likelihood ratios in one other code variant.
struct OtherCode {
    OtherAxis x;
    OtherAxis y;

    /// Returns the likelihood ratio of the same place, with both axes combined.
    float here() const { return x.here * y.here; }
    /// Returns an upper bound on the summed likelihood ratios of all different places, with both
    /// axes combined.
    float elsewhere() const { return x.here * y.elsewhere + x.elsewhere * (y.here + y.elsewhere); }
};

/// Likelihood ratios in all other code variants.
struct OtherCodes {
    bool are_wanted = false;
    /// Value of `log2_in_question_q8` if the code variant is given.
    static constexpr int kNoneInQuestion = -1;
    /// Upper bound on the number of possible code variants, as log2 in units of 2^-8. Each variant
    /// is weighted by its odds relative to the variant that was read.
    int log2_in_question_q8 = 0;
    /// Positions of the first compared column and row, in the code variant that was read.
    Cell first;
    std::array<OtherCode, kCodeVariantCount>
        of;  ///< indexed by code variant; the entry for the variant that was read is unused
};

}  // namespace dotpose::core

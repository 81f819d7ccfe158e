// Other codes: how well a frame agrees with each code variant except the one that was read. The
// attempts compute this agreement, and `Locator` evaluates it.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Likelihood ratios in another code variant, along one axis. The ratios are relative to the place
/// that was read in its own code variant. A place with ratio 1 is as likely as that place.
struct OtherAxis {
    float here = 1;  ///< ratio of the place that was read
    /// Upper bound on the summed ratios of all places other than the place that was read.
    float elsewhere = 0;
    float best = 0;              ///< largest ratio of any examined place other than the place that
                                 ///< was read
    std::uint32_t position = 0;  ///< position of the first line at the place of `best`
    std::uint8_t roll = 0;       ///< roll of that line, minus the roll that was read
};

/// Likelihood ratios in one other code variant.
struct OtherCode {
    OtherAxis x;
    OtherAxis y;

    /// Returns the likelihood ratio of the place that was read, with both axes combined.
    float here() const { return x.here * y.here; }
    /// Returns an upper bound on the summed likelihood ratios of all places other than the place
    /// that was read, with both axes combined.
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

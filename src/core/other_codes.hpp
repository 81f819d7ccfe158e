// Other codes: what the bits of a frame say of the profiles that it was not read in. Filled in by
// the attempts; `locate_in_any_code` makes something of it.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Of one axis. Odds are those of the bits, against the place read; 1: they explain them as well.
struct OtherAxis {
    float here = 1;              ///< odds of the same place in the other profile
    float elsewhere = 0;         ///< summed odds of all its other places, an upper bound
    float best = 0;              ///< odds of the likeliest of these, as far as they were looked at
    std::uint32_t position = 0;  ///< where that has the first line
    std::uint8_t roll = 0;       ///< by how much its roll of that line is larger than that read
};

/// Of one other profile.
struct OtherCode {
    OtherAxis x;
    OtherAxis y;

    /// Odds of the same place by both axes.
    float here() const { return x.here * y.here; }
    /// Those of all other places.
    float elsewhere() const { return x.here * y.elsewhere + x.elsewhere * (y.here + y.elsewhere); }
};

struct OtherCodes {
    bool are_wanted = false;
    /// log2 of how many profiles are in question, 2^-8, by their odds; -1: that read is given.
    int log2_in_question_q8 = 0;
    /// Positions of the first column and row that were compared, in the profile read.
    Cell first;
    std::array<OtherCode, kProfileCount> of;  ///< by profile; that read stays as it is
};

}  // namespace dotpose::core

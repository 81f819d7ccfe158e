// Certainty: how probable it is that a position is wrong whose lines are scored: by chance, by
// alternatives, and by seams. docs/integrity.md derives it.
#pragma once

#include <array>
#include <span>

#include "core/decode/bit_lines.hpp"
#include "core/decode/lines.hpp"
#include "core/integrity/confidence.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// The bits of one axis that were read near the middle, by line, from the first line with any on.
struct AxisBits {
    std::span<const TrackedLine> lines;
    AxisReading reading;    ///< of the first line, at the cells' first bit
    Confidence confidence;  ///< of all bits, against the code
};

/// What is_certain says, told by hard bits alone and without the scores of lines: a tenth of the
/// work, and enough for clean frames. False also where that leaves doubts. Bits that were not read
/// near the middle count for chance only, so the claim is an upper estimate all the same. `others`
/// are told what the bits say of other profiles; null: nobody asks.
bool is_plainly_certain(const Kernels& kernels, const std::array<AxisBits, 2>& axes,
                        Profile profile, const IntegrityOptions& options, Fix& fix,
                        OtherCodes* others = nullptr);

/// What speaks for a position and against it.
struct Evidence {
    Place corner;                    ///< of the first column and row
    std::array<Confidence, 2> bits;  ///< of x and of y, against the code
    Lines columns;
    Lines rows;
};

/// The lines of a block whose cell (0, 0) stands at `place`; their scores go to `storage`.
Evidence evidence_of(const Kernels& kernels, Profile profile, const Place& place,
                     const BitBlock& block, const std::array<Confidence, 2>& bits,
                     std::span<ScoredLine> storage);

/// Sets bit_errors and p_wrong_log2 of the fix: an upper estimate, in integers
/// (quick_alternatives.hpp). False if the position is not certain enough, or too many bits
/// contradict it.
bool is_certain(const Kernels& kernels, const Evidence& evidence, Profile profile,
                const IntegrityOptions& options, Fix& fix, OtherCodes* others = nullptr);

/// Only tells what the bits say of other profiles.
void weigh_other_codes(const Kernels& kernels, const Evidence& evidence, Profile profile,
                       OtherCodes& others);

}  // namespace dotpose::core

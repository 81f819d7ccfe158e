// Certainty: the probability that a position whose lines are scored is wrong, by chance, by
// alternatives and by seams. docs/integrity.md derives it.
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

/// The bits of one axis near the middle, by line, from the first to the last line that has any.
struct AxisBits {
    std::span<const TrackedLine> lines;
    AxisReading reading;                  ///< of the first line, at the first bit of the words
    Confidence confidence;                ///< of all bits read, compared with the code
    std::span<const std::uint8_t> rolls;  ///< of the lines
};

/// Returns whether hard bits alone, without the scores of lines, make the position certain. That
/// takes a tenth of the work of `is_certain` and settles clean frames; it returns false in doubt.
/// Bits that were not read near the middle count for chance only, so the claim stays an upper
/// estimate. `others`, unless null, is told what the bits say of other profiles.
bool is_plainly_certain(const Kernels& kernels, const std::array<AxisBits, 2>& axes,
                        Profile profile, const IntegrityOptions& options, Fix& fix,
                        OtherCodes* others = nullptr);

/// The bits and scores that a position is judged by.
struct Evidence {
    Place corner;                    ///< of the first column and row
    std::array<Confidence, 2> bits;  ///< of x and of y, compared with the code
    Lines columns;
    Lines rows;
};

/// Returns the evidence of a block whose cell (0, 0) is at `place`; scores go to `storage`.
Evidence evidence_of(const Kernels& kernels, Profile profile, const Place& place,
                     const BitBlock& block, const std::array<Confidence, 2>& bits,
                     std::span<ScoredLine> storage);

/// Sets bit_errors and p_wrong_log2 of the fix, the latter an upper estimate. Returns false if the
/// position is not certain enough, or too many bits contradict it. `others`, unless null, is told
/// what the bits say of other profiles.
bool is_certain(const Kernels& kernels, const Evidence& evidence, Profile profile,
                const IntegrityOptions& options, Fix& fix, OtherCodes* others = nullptr);

/// Tells `others` what the bits say of other profiles, without judging the position.
void weigh_other_codes(const Kernels& kernels, const Evidence& evidence, Profile profile,
                       OtherCodes& others);

}  // namespace dotpose::core

// Certainty: an upper bound on the probability that a position is wrong, from chance, alternatives
// and seams. docs/integrity.md derives the bound.
#pragma once

#include <array>
#include <span>

#include "core/decode/bit_lines.hpp"
#include "core/decode/lines.hpp"
#include "core/integrity/compared_line.hpp"
#include "core/integrity/confidence.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Hard bits of one axis near the middle of the view, from the first to the last line that has
/// bits. Each hard bit has the full weight, 127.
struct AxisBits {
    std::span<const ComparedLine> lines;
    AxisReading reading;    ///< reading of the first line, at the first bit of its word
    Confidence confidence;  ///< all bits read on this axis, including bits outside the middle
    std::span<const std::uint8_t> rolls;  ///< roll of each line
};

/// Returns true if the hard bits alone, without the scores of lines, make the position certain.
/// This test takes a tenth of the work of `is_certain` and suffices for clean frames. Returns false
/// if in doubt. Only the bits near the middle of the view are compared with alternatives. Ignoring
/// the other bits can only increase the bound. Sets `bit_errors` of the fix. `p_wrong_log2` of the
/// fix is valid only if the result is true. If the result is true, also sets the odds of the other
/// codes, unless `others` is null.
bool passes_hard_bit_test(const Kernels& kernels, const std::array<AxisBits, 2>& axes,
                          CodeVariant code, const IntegrityOptions& options, Fix& fix,
                          OtherCodes* others = nullptr);

/// Bits and scores from which the certainty of a position is computed.
struct Evidence {
    Place corner;                    ///< place where the first column and the first row cross
    std::array<Confidence, 2> bits;  ///< bits of x and of y, compared with the code
    Lines columns;
    Lines rows;
};

/// Returns the bits of x and of y of an upright block, compared with the code. `place` is the place
/// of cell (0, 0) of the block.
std::array<Confidence, 2> compared_with_code(CodeVariant code, const Place& place,
                                             const BitBlock& block);

/// Returns the evidence of a block whose cell (0, 0) is at `place`. `storage` receives the scores.
Evidence evidence_of(const Kernels& kernels, CodeVariant code, const Place& place,
                     const BitBlock& block, const std::array<Confidence, 2>& bits,
                     std::span<ScoredLine> storage);

/// Returns true if the position is certain: the bound is within the limit, and not too many bits
/// contradict the position. Returns false if there are at most kMaxShared columns or rows. Sets
/// `bit_errors` of the fix. `p_wrong_log2` of the fix is valid only if the result is true. If the
/// result is true, also sets the odds of the other codes, unless `others` is null.
bool is_certain(const Kernels& kernels, const Evidence& evidence, CodeVariant code,
                const IntegrityOptions& options, Fix& fix, OtherCodes* others = nullptr);

/// Sets `p_wrong_log2` of the fix to the smallest integer above log2 of the probability `wrong`, or
/// to 0 if that integer is positive. Returns true if `p_wrong_log2` is at most `limit_log2`.
bool is_within_limit(float wrong, int limit_log2, Fix& fix);

/// Sets the odds of the other codes, without testing the certainty of the position. Does nothing if
/// the bits carry no information.
void weigh_other_codes(const Kernels& kernels, const Evidence& evidence, CodeVariant code,
                       OtherCodes& others);

}  // namespace dotpose::core

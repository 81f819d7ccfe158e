// Certainty: tests whether a position is certain. The test computes an upper bound on the
// probability that the position is wrong because of chance, alternatives or seams, and compares
// this bound with a limit. See docs/integrity.md, "First and tracked attempts".
// likelihood_ratios.hpp defines the terms.
#pragma once

#include <array>
#include <span>

#include "core/decode/bit_lines.hpp"
#include "core/decode/lines.hpp"
#include "core/integrity/compared_line.hpp"
#include "core/integrity/confidence.hpp"
#include "core/integrity/work_limit.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// The hard bits of one axis, near the middle of the view. Each hard bit has the full weight, 127.
struct AxisBits {
    std::span<const ComparedLine> lines;
    AxisReading reading;  ///< position of the first line, and its roll at bit 0
    /// Agreement of all bits of this axis with the code, including the bits outside the middle.
    Confidence confidence;
    std::span<const std::uint8_t> rolls;  ///< roll of each line
};

/// Returns true if the hard bits make the position certain. If the result is false, `is_certain`
/// may still find the position certain. This test takes about a tenth of the time of `is_certain`,
/// and is sufficient for clean frames. It compares alternatives only with the bits near the middle
/// of the view. Ignoring all other bits can only increase the bound on the error probability.
/// Returns false if an axis has at most kMaxShared lines. Sets `fix.bit_errors`. On success, also
/// sets `fix.p_wrong_log2` and, unless `others` is null, the odds of the other codes. On failure,
/// `fix.p_wrong_log2` is not valid.
bool passes_hard_bit_test(const Kernels& kernels, const std::array<AxisBits, 2>& axes,
                          CodeVariant code, const IntegrityOptions& options, Fix& fix,
                          OtherCodes* others = nullptr);

/// Bits and scores that determine whether a position is certain.
struct Evidence {
    Place corner;                    ///< place where the first column and the first row cross
    std::array<Confidence, 2> bits;  ///< agreement of the bits with the code, on the x and y axes
    Lines columns;
    Lines rows;
};

/// Returns the agreement of the bits of an upright block with the code, on the x and y axes. Cell
/// (0, 0) of the block is at `place`.
std::array<Confidence, 2> compared_with_code(CodeVariant code, const Place& place,
                                             const BitBlock& block);

/// Returns the evidence, which consists of `bits` and the scores of the lines in a block. Cell (0,
/// 0) of the block is at `place`. The scores are stored in `storage`, which must outlive the
/// evidence.
Evidence evidence_of(const Kernels& kernels, CodeVariant code, const Place& place,
                     const BitBlock& block, const std::array<Confidence, 2>& bits,
                     std::span<ScoredLine> storage);

/// Returns true if the position is certain: the upper bound on the error probability is at most
/// 2^max_p_wrong_log2, and at most max_bit_error_q8 / 256 of the bits on each axis are wrong (see
/// IntegrityOptions). Returns false if the evidence has at most kMaxShared columns, or at most
/// kMaxShared rows. Sets `fix.bit_errors`. On success, also sets `fix.p_wrong_log2` and, unless
/// `others` is null, the odds of the other codes. On failure, `fix.p_wrong_log2` is not valid.
/// `work` limits the amount of computation, and the function returns false if more would be
/// necessary.
bool is_certain(const Kernels& kernels, const Evidence& evidence, CodeVariant code,
                const IntegrityOptions& options, WorkLimit& work, Fix& fix,
                OtherCodes* others = nullptr);

/// Sets `fix.p_wrong_log2` to the smallest integer above log2(wrong), but at most 0. `wrong` is an
/// upper bound on the error probability, and must be positive. Returns true if `fix.p_wrong_log2`
/// is at most `limit_log2`.
bool is_within_limit(float wrong, int limit_log2, Fix& fix);

/// Sets the odds of the other codes without a certainty test, as for an unknown error rate. Does
/// nothing if the bits contain no information.
void weigh_other_codes(const Kernels& kernels, const Evidence& evidence, CodeVariant code,
                       OtherCodes& others);

}  // namespace dotpose::core

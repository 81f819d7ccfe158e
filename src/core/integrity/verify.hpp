// Verify: compares all dots in view with the decoded position. The decoder may have used only some
// of the dots. Unlike the paper, dotpose rejects decoded positions that may be wrong. See
// docs/differs-from-paper.md.
#pragma once

#include "core/decode/grid.hpp"
#include "core/decode/lines.hpp"
#include "core/integrity/compared_line.hpp"
#include "core/integrity/work_limit.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Verifies a decoded position. Sets `fix.bit_errors`, `fix.p_wrong_log2` and `decoding.bits`. The
/// probability accounts for chance matches, alternatives and seams between sections.
/// - `others` contains log2 of the number of possible codes (`log2_in_question_q8`). May be null if
///   the code is given.
/// - If `decoding.lines_are_scored` is true, `storage` must contain the line scores computed by the
///   decoder.
/// - `work` limits the amount of computation for counting alternatives one by one. If an axis has
/// at
///   most kMaxShared lines, they are not counted, and only the quick bound is used.
///
/// Error: not_certain, if the probability exceeds the limit in `options`, if it cannot be computed
/// within the work limit, or if the fraction of wrong bits on an axis exceeds its limit.
Status verify(const Kernels& kernels, const Grid& grid, CodeVariant code, const OtherCodes* others,
              const IntegrityOptions& options, std::span<ScoredLine> storage, WorkLimit& work,
              Decoding& decoding, Fix& fix);

/// Verifies a decoded position in integer arithmetic and in bounded time. Rejects more positions
/// than `verify`, because it uses only the bound on the alternatives from quick_alternatives.hpp.
/// Error: not_certain, for the same reasons as in `verify`.
Status verify_quickly(const Grid& grid, CodeVariant code, Decoding& decoding,
                      const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// Variant of `verify_quickly` for tracked frames. All bits have the same weight. The first half of
/// `lines` contains the columns, and the second half contains the rows. The first column and the
/// first row cross at `corner`.
Status verify_tracked(CodeVariant code, std::span<const ComparedLine> lines, const Place& corner,
                      const IntegrityOptions& options, Decoding& decoding, Fix& fix);

/// Sets the odds of all codes except `code`, which is the code of the reading. Does nothing if
/// `others` is null or if the bits contain no information.
void weigh_other_codes(const Kernels& kernels, const Grid& grid, CodeVariant code,
                       const Decoding& decoding, std::span<ScoredLine> storage, OtherCodes* others);

}  // namespace dotpose::core

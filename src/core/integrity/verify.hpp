// Verify: compares all dots in view with the decoded position. The decoder may have used only some
// of the dots. Unlike the paper, dotpose does not accept every decoded position
// (docs/differs-from-paper.md).
#pragma once

#include "core/decode/grid.hpp"
#include "core/decode/lines.hpp"
#include "core/integrity/compared_line.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Sets `bit_errors` and `p_wrong_log2` of the fix, and `bits` and `p_wrong_log2_q8` of the
/// decoding. The probability includes chance, alternatives and seams. First uses the odds of the
/// alternatives from quick_alternatives.hpp. If the probability then exceeds the limit or 2^-30,
/// uses the odds from alternatives.hpp for the axes in doubt. `others` contains the number of
/// possible codes, and may be null if the code is given. Errors: not_certain, if the probability
/// exceeds the limit or too many bits contradict the position.
Status verify(const Kernels& kernels, const Grid& grid, CodeVariant code, const OtherCodes* others,
              Decoding& decoding, const IntegrityOptions& options, std::span<ScoredLine> storage,
              Fix& fix);

/// Verifies a decoded position in integers and in bounded time. Uses only quick_alternatives.hpp,
/// so it refuses more positions than `verify`. Errors: not_certain, for the same reasons as in
/// `verify`.
Status verify_quickly(const Grid& grid, CodeVariant code, Decoding& decoding,
                      const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// Verifies a tracked frame as `verify_quickly` does. All bits have the same weight. The first half
/// of `lines` contains the columns, and the second half contains the rows. The first column and the
/// first row cross at `corner`.
Status verify_tracked(CodeVariant code, std::span<const ComparedLine> lines, const Place& corner,
                      const IntegrityOptions& options, Decoding& decoding, Fix& fix);

/// Sets the odds of all codes except `code`, in which the grid was read. Does nothing if `others`
/// is null or if the bits carry no information.
void weigh_other_codes(const Kernels& kernels, const Grid& grid, CodeVariant code,
                       const Decoding& decoding, std::span<ScoredLine> storage, OtherCodes* others);

}  // namespace dotpose::core

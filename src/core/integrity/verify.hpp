// Verify: compares all dots in view with the position that a part of them gave. differs: the paper
// accepts every position that decodes; see docs/differs-from-paper.md.
#pragma once

#include "core/decode/grid.hpp"
#include "core/decode/lines.hpp"
#include "core/integrity/compared_line.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Sets `bit_errors` and `p_wrong_log2` of the fix, and `p_wrong_log2_q8` of the decoding, from
/// chance and alternatives: by quick_alternatives.hpp, and by alternatives.hpp where these leave
/// doubts. `others` lists the possible codes; null means one code. Errors: not_certain.
Status verify(const Grid& grid, CodeVariant code, const OtherCodes* others, Decoding& decoding,
              const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// Does the same in integers only and in bounded time. Positions that quick_alternatives.hpp leaves
/// in doubt are refused.
Status verify_quickly(const Grid& grid, CodeVariant code, Decoding& decoding,
                      const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// Does the same for a tracked frame, whose bits all have the same weight. `lines` are the columns,
/// then in the second half the rows; `corner` is the place of the first of each.
Status verify_tracked(CodeVariant code, std::span<const ComparedLine> lines, const Place& corner,
                      const IntegrityOptions& options, Decoding& decoding, Fix& fix);

/// Sets the odds of the codes other than the one the grid was read in. `others` may be null.
void weigh_other_codes(const Kernels& kernels, const Grid& grid, CodeVariant code,
                       const Decoding& decoding, std::span<ScoredLine> storage, OtherCodes* others);

}  // namespace dotpose::core

// Verify: compares all dots in view with the decoded position. The position was decoded from some
// of the dots. differs: the paper accepts every position that decodes; see
// docs/differs-from-paper.md.
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

/// Sets `bit_errors` and `p_wrong_log2` of the fix, and `p_wrong_log2_q8` of the decoding, from
/// chance and alternatives. Uses quick_alternatives.hpp, and alternatives.hpp if the quick bound
/// exceeds the limit. `others` contains the number of possible codes, and is null if the code is
/// given. Errors: not_certain.
Status verify(const Grid& grid, CodeVariant code, const OtherCodes* others, Decoding& decoding,
              const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// Variant of `verify` that uses only integers and takes bounded time. Refuses a position if the
/// bound of quick_alternatives.hpp exceeds the limit.
Status verify_quickly(const Grid& grid, CodeVariant code, Decoding& decoding,
                      const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// Variant of `verify_quickly` for a tracked frame, in which all bits have the same weight. The
/// first half of `lines` contains the columns, the second half the rows. `corner` is the place of
/// the first column and row.
Status verify_tracked(CodeVariant code, std::span<const ComparedLine> lines, const Place& corner,
                      const IntegrityOptions& options, Decoding& decoding, Fix& fix);

/// Sets the odds of the codes other than the code in which the grid was read. `others` may be null.
void weigh_other_codes(const Kernels& kernels, const Grid& grid, CodeVariant code,
                       const Decoding& decoding, std::span<ScoredLine> storage, OtherCodes* others);

}  // namespace dotpose::core

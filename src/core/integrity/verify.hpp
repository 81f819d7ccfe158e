// Verify: all dots in view against the position that a part of them gave, and how probable it is
// that chance would agree as well. differs: the paper accepts whatever decodes; see
// docs/differs-from-paper.md.
#pragma once

#include <optional>

#include "core/decode/lines.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"
#include "core/stages.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Sets bit_errors and p_wrong_log2 of the fix, and p_wrong_log2_q8 of the decoding: from chance,
/// and from alternatives (quick_alternatives.hpp, and alternatives.hpp where they leave doubts).
/// Errors: not_certain.
Status verify(const Grid& grid, Profile profile, Decoding& decoding,
              const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// The same with as many profiles in question as `others` say; null: one.
Status verify_among_codes(const Grid& grid, Profile profile, const OtherCodes* others,
                          Decoding& decoding, const IntegrityOptions& options,
                          std::span<ScoredLine> storage, Fix& fix);

/// The same in integers only, and in bounded time: what quick_alternatives leaves in doubt is
/// refused.
Status verify_quickly(const Grid& grid, Profile profile, Decoding& decoding,
                      const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// The same of bits that are all equally sure, of a tracked frame, whose place is known.
Status verify_tracked(Profile profile, const Tracking& tracking, const IntegrityOptions& options,
                      Decoding& decoding, Fix& fix);

/// What the bits of a grid say of other profiles than the one that it was read in. `others` are
/// null if nobody asks.
void weigh_other_codes(const Kernels& kernels, const Grid& grid, Profile profile,
                       const Decoding& decoding, std::span<ScoredLine> storage, OtherCodes* others);

/// Whether two places show the same bits of this axis around them.
bool share_line(Axis axis, Profile profile, const Place& a, const Place& b);

/// The axis of a refused decoding that, of the two, is the less doubtful and by itself beyond
/// doubt.
std::optional<Axis> sure_axis(const Decoding& decoding, const IntegrityOptions& options);

}  // namespace dotpose::core

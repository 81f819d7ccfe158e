// Verify: compares all dots in view with the position that a part of them gave. differs: the paper
// accepts every position that decodes; see docs/differs-from-paper.md.
#pragma once

#include "core/decode/lines.hpp"
#include "core/kernels/kernels.hpp"
#include "core/other_codes.hpp"
#include "core/stages.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Sets `bit_errors` and `p_wrong_log2` of the fix, and `p_wrong_log2_q8` of the decoding, from
/// chance and alternatives: by quick_alternatives.hpp, and by alternatives.hpp where these leave
/// doubts. Errors: not_certain.
Status verify(const Grid& grid, Profile profile, Decoding& decoding,
              const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// Does the same for several possible codes, given by `others`; null means one code.
Status verify_among_codes(const Grid& grid, Profile profile, const OtherCodes* others,
                          Decoding& decoding, const IntegrityOptions& options,
                          std::span<ScoredLine> storage, Fix& fix);

/// Does the same in integers only and in bounded time. Positions that quick_alternatives.hpp leaves
/// in doubt are refused.
Status verify_quickly(const Grid& grid, Profile profile, Decoding& decoding,
                      const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix);

/// Does the same for a tracked frame: its place is known and all its bits have the same weight.
Status verify_tracked(Profile profile, const Tracking& tracking, const IntegrityOptions& options,
                      Decoding& decoding, Fix& fix);

/// Sets the odds of the codes other than the one the grid was read in. `others` may be null.
void weigh_other_codes(const Kernels& kernels, const Grid& grid, Profile profile,
                       const Decoding& decoding, std::span<ScoredLine> storage, OtherCodes* others);

}  // namespace dotpose::core

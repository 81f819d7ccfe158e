// Position: the turn and the place in the code. Paper section II-B.6 and II-B.7.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// The paper's decoder: orientation by voting and weighted correlation of each line of the best 8 x
/// 8 symbols. The baseline. Errors: grid_too_small, not_in_code, ambiguous.
Status decode_window(const Grid& grid, Profile profile, std::span<ScoredLine> storage,
                     Decoding& decoding);

/// The decoder from all dots: soft correlation of all lines, the position by the sum over all of
/// them; of the two likeliest turns that which sums up to more. Errors: grid_too_small,
/// not_in_code.
Status decode_all(const Grid& grid, Profile profile, std::span<ScoredLine> storage,
                  Decoding& decoding);

/// The same in bounded time, for first attempts: what is not found soon is rarely certain.
Status decode_briefly(const Grid& grid, Profile profile, std::span<ScoredLine> storage,
                      Decoding& decoding);

}  // namespace dotpose::core

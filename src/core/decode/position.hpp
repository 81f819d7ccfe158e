// Position: the turn and the place in the code. Paper section II-B.6 and II-B.7.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Decodes as the paper does, which is the baseline: orientation by voting, and weighted
/// correlation of each line of the best 8 x 8 symbols. Errors: grid_too_small, not_in_code,
/// ambiguous.
Status decode_window(const Grid& grid, Profile profile, std::span<ScoredLine> storage,
                     Decoding& decoding);

/// Decodes from all dots: weighted correlation of all lines, and of the positions the one with the
/// largest sum of scores; of the two likeliest turns the one with the larger sum. Errors:
/// grid_too_small, not_in_code.
Status decode_all(const Grid& grid, Profile profile, std::span<ScoredLine> storage,
                  Decoding& decoding);

/// Decodes from all dots in bounded time, for first attempts; a position that is not found soon is
/// rarely certain.
Status decode_briefly(const Grid& grid, Profile profile, std::span<ScoredLine> storage,
                      Decoding& decoding);

}  // namespace dotpose::core

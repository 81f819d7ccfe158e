// Correlation: correlates the weights of the bits of a line with the main sequence at every roll.
// Paper section II-B.7.
#pragma once

#include <cstdint>
#include <span>

#include "core/kernels/scores.hpp"

namespace dotpose::core {

/// A roll (an offset in the main sequence) and its score.
struct Match {
    std::int32_t score = 0;
    std::uint8_t roll = 0;
};

/// Computes the score of each roll. The score is the sum of all weights, each multiplied by +1 if
/// the corresponding bit of the main sequence is 1, and by -1 if the corresponding bit is 0. At
/// roll o, the first weight corresponds to bit o. Doubtful bits have small weights. `weights`
/// contains at most 256 values in [-127, 127].
void correlate(std::span<const std::int8_t> weights, LineScores& scores);

/// Correlates two lines. Takes little more time than `correlate` takes for one line.
void correlate_both(std::span<const std::int8_t> a, std::span<const std::int8_t> b,
                    LineScores& scores_a, LineScores& scores_b);

/// Returns the roll with the best score. Ties are broken by the smallest roll.
Match best_match(const LineScores& scores);

/// Returns the match that follows `last` in decreasing order of scores. Matches of equal score are
/// in increasing order of rolls.
Match next_match(const LineScores& scores, Match last);

/// Returns the best score and its margin over the second best score.
BestScore best_score(const LineScores& scores);

/// The maximum and the minimum score of a line.
struct Extremes {
    std::int32_t max = 0;
    std::int32_t min = 0;
};

Extremes extremes_of(const LineScores& scores);

}  // namespace dotpose::core

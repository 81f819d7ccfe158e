// Correlation: scores a line at each roll (paper, section II-B.7). A *roll* is the index in the
// main sequence at which the line starts.
#pragma once

#include <cstdint>
#include <span>

#include "core/kernels/scores.hpp"

namespace dotpose::core {

struct Match {
    std::int32_t score = 0;
    std::uint8_t roll = 0;
};

/// Computes the score of a line at each roll: the sum of its weights, each negated where the main
/// sequence is 0. At roll o, the first weight is compared with bit o of the main sequence.
/// `weights` contains at most 256 values in [-127, 127]. Doubtful bits have small weights.
void correlate(std::span<const std::int8_t> weights, LineScores& scores);

/// Correlates two lines. Takes only slightly longer than one call to `correlate`.
void correlate_both(std::span<const std::int8_t> a, std::span<const std::int8_t> b,
                    LineScores& scores_a, LineScores& scores_b);

/// Returns the roll with the highest score. Ties are broken by taking the smallest roll.
Match best_match(const LineScores& scores);

/// Returns the match after `last` in order of decreasing score. Matches with equal scores are
/// ordered by increasing roll. At least one match must follow `last`.
Match next_match(const LineScores& scores, Match last);

/// Returns the highest score and its margin over the second highest score.
BestScore best_score(const LineScores& scores);

struct Extremes {
    std::int32_t max = 0;
    std::int32_t min = 0;
};

Extremes extremes_of(const LineScores& scores);

}  // namespace dotpose::core

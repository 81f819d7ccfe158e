// Correlation of a line of likelihoods with the main sequence at every offset. Paper section
// II-B.7.
#pragma once

#include <cstdint>
#include <span>

#include "core/stages.hpp"

namespace dotpose::core {

/// An offset of the main sequence and how well it agrees.
struct Match {
    std::int32_t score = 0;
    std::uint8_t roll = 0;
};

/// scores[o] = sum of the weights that agree with the main sequence from index o on, minus those
/// that do not; the weights soften doubtful bits. At most 256 weights in [-127, 127].
void correlate(std::span<const std::int8_t> weights, LineScores& scores);

/// The same for two lines in little more time.
void correlate_both(std::span<const std::int8_t> a, std::span<const std::int8_t> b,
                    LineScores& scores_a, LineScores& scores_b);

/// The best of all offsets; the smallest of equal ones.
Match best_match(const LineScores& scores);

/// The best of those that are less good than `last`, or as good and larger.
Match next_match(const LineScores& scores, Match last);

BestScore best_score(const LineScores& scores);

struct Extremes {
    std::int32_t most = 0;
    std::int32_t least = 0;
};

Extremes extremes_of(const LineScores& scores);

}  // namespace dotpose::core

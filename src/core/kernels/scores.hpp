// Scores: agreement of columns and rows with the main sequence. Paper section II-B.7.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Maximum number of columns, and of rows, that are decoded. If more lines are in view, the lines
/// with the clearest bits are decoded.
inline constexpr int kMaxLines = 64;

/// Agreement of one column or row with the main sequence at each roll.
using LineScores = std::array<std::int16_t, kSections>;

/// The best score, and its margin over the second best score.
struct BestScore {
    std::int16_t score = 0;
    std::int16_t margin = 0;
};

/// A column or row with its scores.
struct ScoredLine {
    LineScores scores{};
    BestScore best;
};

}  // namespace dotpose::core

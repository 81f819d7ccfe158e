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

/// The highest score of a line, and its margin over the second highest score.
struct BestScore {
    std::int16_t score = 0;
    std::int16_t margin = 0;
};

/// A column or row with its scores.
struct ScoredLine {
    LineScores scores{};
    BestScore best;
};

/// Number of entries of a table indexed by roll: kSections, rounded up to whole vectors. The last
/// entry is not used.
inline constexpr std::size_t kRollEntries = 64;

/// Scores of up to kMaxLines adjacent lines at each roll. The score is the number of cells that
/// agree with the main sequence. The scores of a line are stored twice in succession, so
/// kRollEntries scores can be loaded starting at any roll.
struct RollScores {
    int count = 0;  ///< number of lines
    std::array<std::array<std::uint16_t, 2 * kRollEntries>, kMaxLines> lines;
};

/// Sums of the scores of all lines, indexed by the common offset that is added to their rolls.
using RollSums = std::array<std::uint16_t, kRollEntries>;

}  // namespace dotpose::core

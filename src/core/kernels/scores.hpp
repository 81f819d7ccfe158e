// Scores: how well columns and rows agree with the main sequence (paper, section II-B.7).
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Maximum number of decoded lines per axis. If more lines are in view, the decoder uses the lines
/// with the clearest bits.
inline constexpr int kMaxLines = 64;

/// Agreement of one column or row with the main sequence, indexed by roll.
using LineScores = std::array<std::int16_t, kSections>;

/// The highest score of a line, and its margin over the second highest.
struct BestScore {
    std::int16_t score = 0;
    std::int16_t margin = 0;
};

/// A column or row with its scores.
struct ScoredLine {
    LineScores scores{};
    BestScore best;
};

/// Size of a table indexed by roll: kSections rounded up to a multiple of the vector length. The
/// last entry is unused.
inline constexpr std::size_t kRollEntries = 64;

/// Scores of up to kMaxLines adjacent lines, indexed by roll. A score is the number of cells that
/// agree with the main sequence. Each line contains two consecutive copies of its scores, so that
/// kRollEntries consecutive scores can be loaded starting at any roll.
struct RollScores {
    int count = 0;  ///< number of lines
    std::array<std::array<std::uint16_t, 2 * kRollEntries>, kMaxLines> lines;
};

/// Total score of all lines, indexed by the offset that is added to every roll.
using RollSums = std::array<std::uint16_t, kRollEntries>;

}  // namespace dotpose::core

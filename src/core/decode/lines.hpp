// Lines: all columns (or rows) of an upright region, each correlated with the main sequence.
#pragma once

#include <array>
#include <span>

#include "core/decode/upright.hpp"
#include "core/stages.hpp"

namespace dotpose::core {

enum class Axis : std::uint8_t {
    x,  ///< the x bits, down the columns
    y,  ///< the y bits, along the rows
};

/// The scores of all lines of one axis.
struct Lines {
    std::span<const ScoredLine> all;
    int count() const { return static_cast<int>(all.size()); }
    const LineScores& operator[](int line) const {
        return all[static_cast<std::size_t>(line)].scores;
    }
    const BestScore& best(int line) const { return all[static_cast<std::size_t>(line)].best; }
};

/// Returns the half of the storage that is for one axis.
inline std::span<ScoredLine> scores_of(Axis axis, std::span<ScoredLine> storage) {
    const std::size_t half = storage.size() / 2;
    return axis == Axis::x ? storage.first(half) : storage.last(half);
}

/// Scores all lines of the region; it may have at most as many as `storage` holds.
Lines score_lines(const Upright& upright, Axis axis, std::span<ScoredLine> storage);

/// Returns the lines that `score_lines` has left in the storage.
Lines scored_lines(const Upright& upright, Axis axis, std::span<ScoredLine> storage);

/// The position that the lines of one axis are read as.
struct AxisReading {
    std::uint32_t position = 0;      ///< of the first line
    std::uint8_t roll = 0;           ///< of the first line, at the first cell of the crossing lines
    std::int32_t score = 0;          ///< sum over all lines
    std::int32_t most_possible = 0;  ///< sum of the best score of each line alone

    /// Returns whether the score is so near the most possible that no other reading can come near
    /// it.
    bool is_clear() const { return 8 * std::int64_t{score} > 7 * std::int64_t{most_possible}; }
};

}  // namespace dotpose::core

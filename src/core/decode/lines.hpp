// Lines: correlates all columns (or rows) of an upright region with the main sequence.
#pragma once

#include <array>
#include <span>

#include "core/decode/upright.hpp"
#include "core/kernels/scores.hpp"

namespace dotpose::core {

enum class Axis : std::uint8_t {
    x,  ///< columns, which are read downwards and contain the x bits
    y,  ///< rows, which are read to the right and contain the y bits
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

/// Returns the half of the storage that is reserved for the lines of an axis.
inline std::span<ScoredLine> scores_of(Axis axis, std::span<ScoredLine> storage) {
    const std::size_t half = storage.size() / 2;
    return axis == Axis::x ? storage.first(half) : storage.last(half);
}

/// Scores all lines of one axis of the region. `storage` must have at least one element per line.
Lines score_lines(const Upright& upright, Axis axis, std::span<ScoredLine> storage);

/// Returns the lines that were scored by the last call of `score_lines` with the same arguments.
Lines scored_lines(const Upright& upright, Axis axis, std::span<ScoredLine> storage);

/// The decoded position of the lines of one axis, and its score.
struct AxisReading {
    std::uint32_t position = 0;  ///< position of the first line
    std::uint8_t roll = 0;       ///< roll of the first line at its first cell
    std::int32_t score = 0;      ///< sum of the scores of all lines
    /// Upper bound on `score`: the sum of the highest scores of all lines, each at its own best
    /// roll.
    std::int32_t max_possible = 0;

    /// Returns true if the score exceeds 7/8 of `max_possible`. A search stops at a clear reading,
    /// because no other reading is likely to have a similar score.
    bool is_clear() const { return 8 * std::int64_t{score} > 7 * std::int64_t{max_possible}; }
};

}  // namespace dotpose::core

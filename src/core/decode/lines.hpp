// Lines: the columns and rows of an upright region, scored against the main sequence.
#pragma once

#include <array>
#include <span>

#include "core/decode/upright.hpp"
#include "core/kernels/scores.hpp"

namespace dotpose::core {

enum class Axis : std::uint8_t {
    x,  ///< columns, which contain the x bits and are read downwards
    y,  ///< rows, which contain the y bits and are read to the right
};

/// The scored lines of one axis.
struct Lines {
    std::span<const ScoredLine> all;
    int count() const { return static_cast<int>(all.size()); }
    const LineScores& operator[](int line) const {
        return all[static_cast<std::size_t>(line)].scores;
    }
    const BestScore& best(int line) const { return all[static_cast<std::size_t>(line)].best; }
};

/// Returns the half of `storage` for an axis: the first half for x, the second half for y.
inline std::span<ScoredLine> scores_of(Axis axis, std::span<ScoredLine> storage) {
    const std::size_t half = storage.size() / 2;
    return axis == Axis::x ? storage.first(half) : storage.last(half);
}

/// Scores all lines of an axis. `storage` needs at least one element per line.
Lines score_lines(const Upright& upright, Axis axis, std::span<ScoredLine> storage);

/// Returns the result of an earlier call to `score_lines` with the same arguments. `storage` must
/// still contain the scores.
Lines scored_lines(const Upright& upright, Axis axis, std::span<ScoredLine> storage);

/// A position decoded from the lines of one axis.
struct AxisReading {
    std::uint32_t position = 0;  ///< position of the first line
    std::uint8_t roll = 0;       ///< roll of the first line at its first cell
    std::int32_t score = 0;      ///< total score over all lines
    /// Upper bound on `score`: the sum of each line's highest score.
    std::int32_t max_possible = 0;

    /// Returns true if the score exceeds 7/8 of `max_possible`. The search then stops, because it
    /// is unlikely that another reading has a higher score.
    bool is_clear() const { return 8 * std::int64_t{score} > 7 * std::int64_t{max_possible}; }
};

}  // namespace dotpose::core

// Regularity: how well dots sit on a grid that is fitted to more and more of them.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/lattice/tuning.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Of a dot from its intersection, in spacings, as the pattern is usually printed.
inline constexpr std::int32_t kDisplacement_q16 = 65536 / 6;

/// How far, in cells, the first estimate can be trusted: 3 % of error in the spacing, 1 degree in
/// the direction and 1/20 cell in the origin, added up, stay under the 1/3 cell that tells a
/// displaced dot from one of the next cell.
inline constexpr int kFirstReach_cells = 4;

/// Of the dots within reach.
struct Regularity {
    int dots = 0;
    int near_intersections = 0;
    int farthest_cell = 0;  ///< of all dots, within reach or not

    bool is_settled() const {
        return 20 * near_intersections >= tuning::regularity::kSettled_20th * dots;
    }

    /// From the mean square of all offsets, in spacings^2. Dots anywhere in their cells would be
    /// near an intersection in half of the cases, at a mean of 1/6; displaced ones always, at 1/36;
    /// those of a plain grid at 0.
    Status verdict(std::int64_t mean_square_q20) const {
        constexpr std::int64_t kScattered_q20 = (1 << 20) / 10;
        constexpr std::int64_t kUndisplaced_q20 = (1 << 20) / 256;
        if (10 * near_intersections < tuning::regularity::kFewest_10ths * dots ||
            mean_square_q20 > kScattered_q20) {
            return Status::no_grid;
        }
        return mean_square_q20 < kUndisplaced_q20 ? Status::no_displacement : Status::ok;
    }
};

/// From the first reach out to the farthest dot: calls `fit(reach_cells)`, which fits the grid to
/// the dots within and sets `found`, until these are settled, but at most `most_rounds` times:
/// dots that a better fit puts into other cells make the next one better still. False if a fit
/// fails.
template <typename Fit>
bool fit_outwards(int most_rounds, const Regularity& found, Fit fit) {
    for (int reach = kFirstReach_cells;; reach += reach / 2 + 1) {
        for (int round = 0; round < most_rounds; ++round) {
            if (!fit(reach)) return false;
            if (found.is_settled()) break;
        }
        if (reach >= found.farthest_cell) return true;
    }
}

}  // namespace dotpose::core

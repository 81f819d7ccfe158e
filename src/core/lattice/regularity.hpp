// Regularity: agreement of the dots with a grid that is fitted to more and more dots.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/lattice/tuning.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Nominal displacement of a dot from its intersection, in spacings.
inline constexpr std::int32_t kDisplacement_q16 = 65536 / 6;

/// Distance from the origin, in cells, within which the first estimate is reliable. Errors of 3 %
/// of the spacing, 1 degree in the direction and 1/20 cell in the origin add up to less than 1/3
/// cell at this distance. 1/3 cell is the distance between a displaced dot and the border of the
/// cell.
inline constexpr int kFirstReach_cells = 4;

/// Statistics of the dots within reach.
struct Regularity {
    int dots = 0;
    int near_intersections = 0;
    /// Maximum distance of the cell of any dot from the origin, in cells. Includes dots beyond the
    /// reach, but not dots beyond kFarthest_cells, which the callers ignore.
    int farthest_cell = 0;

    /// Returns true if at least the fraction kSettled_20th / 20 of the dots is near an
    /// intersection. The reach may then be extended.
    bool is_settled() const {
        return 20 * near_intersections >= tuning::regularity::kSettled_20th * dots;
    }

    /// Returns the status of the grid, given the mean square of the offsets of all dots from their
    /// intersections, in spacings^2. If dots are at random places, half of them are near an
    /// intersection, and the mean square is 1/6. If dots are displaced from the intersections of a
    /// grid, all of them are near an intersection, and the mean square is 1/36. The mean square of
    /// a plain dot grid is 0.
    Status verdict(std::int64_t mean_square_q20) const {
        constexpr std::int64_t kScattered_q20 = (1 << 20) / 10;
        constexpr std::int64_t kUndisplaced_q20 = (1 << 20) / 256;
        if (10 * near_intersections < tuning::regularity::kMin_10ths * dots ||
            mean_square_q20 > kScattered_q20) {
            return Status::no_grid;
        }
        return mean_square_q20 < kUndisplaced_q20 ? Status::no_displacement : Status::ok;
    }
};

/// Extends a fit from kFirstReach_cells to the farthest dot. `fit(reach_cells)` fits the grid to
/// the dots within the reach, sets `found`, and returns false if the fit fails. Calls `fit` at most
/// `max_rounds` times for each reach, until enough dots are near an intersection, because a better
/// fit assigns more dots to the correct cells. Returns false if a fit fails.
template <typename Fit>
bool fit_outwards(int max_rounds, const Regularity& found, Fit fit) {
    for (int reach = kFirstReach_cells;; reach += reach / 2 + 1) {
        for (int round = 0; round < max_rounds; ++round) {
            if (!fit(reach)) return false;
            if (found.is_settled()) break;
        }
        if (reach >= found.farthest_cell) return true;
    }
}

}  // namespace dotpose::core

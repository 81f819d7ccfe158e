// Regularity: measures how well the dots agree with a grid that is fitted outwards, to more dots in
// each step. A fit with *reach* r uses the dots whose cells are at most r cells from the origin
// along each axis.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/lattice/tuning.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Nominal displacement of a dot from its intersection, in 2^-16 spacings.
inline constexpr std::int32_t kDisplacement_q16 = 65536 / 6;

/// Distance from the origin up to which the first estimate is reliable, in cells. Up to this
/// distance, errors of 3 % in spacing, 1 degree in direction and 1/20 cell in the origin add up to
/// less than 1/3 cell. Each dot is then assigned to the correct cell, because displaced dots are
/// 1/3 cell from the nearest border of their cells.
inline constexpr int kFirstReach_cells = 4;

/// Statistics of the dots within the reach of a fit.
struct Regularity {
    int dots = 0;
    int near_intersections = 0;
    /// Largest distance from the origin to the cell of a dot, in cells. Unlike the other members,
    /// this includes dots beyond the reach. It excludes dots farther than kFarthest_cells, because
    /// callers skip them.
    int farthest_cell = 0;

    /// Returns true if at least kRegular_20th / 20 of the dots are near an intersection. Repeating
    /// the fit at the same reach is then unnecessary.
    bool is_regular() const {
        return 20 * near_intersections >= tuning::regularity::kRegular_20th * dots;
    }

    /// Returns no_grid if the dots do not form a grid, and no_displacement for a plain dot grid.
    /// `mean_square_q20` is the mean squared distance from the dots to their nearest intersections,
    /// in 2^-20 spacings^2. In spacings^2, the mean is 1/6 for randomly placed dots, 1/36 for
    /// displaced dots on a grid, and 0 for a plain dot grid. In a grid, at least kMin_10ths / 10 of
    /// the dots must be near an intersection. If dots are placed randomly, only half of them are
    /// near an intersection.
    Status verdict(std::int64_t mean_square_q20) const {
        constexpr std::int64_t kScattered_q20 = (1 << 20) / 10;
        constexpr auto kUndisplaced_q20 =
            static_cast<std::int64_t>(tuning::kMaxUndisplaced * (1 << 20));
        if (10 * near_intersections < tuning::regularity::kMin_10ths * dots ||
            mean_square_q20 > kScattered_q20) {
            return Status::no_grid;
        }
        return mean_square_q20 < kUndisplaced_q20 ? Status::no_displacement : Status::ok;
    }
};

/// Extends a fit from kFirstReach_cells to the farthest dot. `fit(reach_cells)` must fit the grid
/// to the dots whose cells are at most `reach_cells` from the origin, and set `found`. Each
/// fit assigns more dots to the correct cells. At each reach, the fit is therefore repeated until
/// enough dots are near an intersection, but at most `max_rounds` times. The reach is then
/// extended, even if too few dots are near an intersection. Returns false if `fit` returns false.
template <typename Fit>
bool fit_outwards(int max_rounds, const Regularity& found, Fit fit) {
    for (int reach = kFirstReach_cells;; reach += reach / 2 + 1) {
        for (int round = 0; round < max_rounds; ++round) {
            if (!fit(reach)) return false;
            if (found.is_regular()) break;
        }
        if (reach >= found.farthest_cell) return true;
    }
}

}  // namespace dotpose::core

// Likelihood: the quasi-probabilities of the bits of each dot. Paper section II-B.4, eq. 7-9, Fig.
// 7-8.
#pragma once

#include "core/decode/grid.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Returns the quasi-probability f(r) of eq. 9 for a projected offset in units of 2^-16 spacings.
/// The result is in [-127, 127], in units of 1/127.
std::int8_t quasi_probability(std::int32_t projection_q16);

/// Clears the grid and sets its extent to the cells from `min` to `max`. If an axis has more than
/// `grid.side` cells, the extent is limited to the cells nearest to cell (0, 0).
void lay_out(FixedVec min, FixedVec max, Grid& grid);

/// Fills the matrices P of Fig. 8 from all dots. If a cell contains several dots, only the dot with
/// the highest quality is used. A grid with more than `grid.side` cells along an axis is cropped to
/// the `grid.side` cells nearest to cell (0, 0). Error: grid_too_small, if the dots extend over
/// fewer than kWindowSide columns or rows.
Status assign_likelihoods(std::span<const DetectedDot> dots, const PlaneFromImage& grid_from_image,
                          Grid& grid);

/// Faster variant of `assign_likelihoods` for a plane without perspective or lens distortion.
/// Error: grid_too_small, if the dots extend over fewer than `min_side` columns or rows.
Status assign_affine_likelihoods(std::span<const DetectedDot> dots,
                                 const PlaneFromImage& grid_from_image, Grid& grid,
                                 int min_side = kWindowSide);

/// Returns the quality |P^(x) P^(y)| of a cell, at most 127 * 127. The quality is high if the dot
/// of the cell is close to the place of a symbol.
inline int quality(const GridCell& cell) {
    const int product = cell.x * cell.y;
    return product < 0 ? -product : product;
}

}  // namespace dotpose::core

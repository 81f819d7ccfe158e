// Likelihood: quasi-probabilities of bits, computed from the offsets of the dots (paper, section
// II-B.4, equations 7 to 9).
#pragma once

#include "core/decode/grid.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Returns the quasi-probability f(r) of a bit, from -127 to 127 (paper, equation 9).
/// `projection_q16` is the dot's projected offset, in 2^-16 spacings.
std::int8_t quasi_probability(std::int32_t projection_q16);

/// Clears the grid and sets its extent to the cells from `min` to `max`. If an axis has more than
/// `grid.side` cells, keeps the `grid.side` cells nearest cell (0, 0).
void lay_out(FixedVec min, FixedVec max, Grid& grid);

/// Fills the grid from all dots (paper, figure 8). If a cell contains several dots, uses the dot
/// with the highest quality. If an axis has more than `grid.side` cells, keeps the `grid.side`
/// cells nearest cell (0, 0). Error: grid_too_small if the dots span fewer than kWindowSide columns
/// or rows.
Status assign_likelihoods(std::span<const DetectedDot> dots, const PlaneFromImage& grid_from_image,
                          Grid& grid);

/// Faster variant of `assign_likelihoods`, for a plane without perspective or lens distortion.
/// Error: grid_too_small if the dots span fewer than `min_side` columns or rows.
Status assign_affine_likelihoods(std::span<const DetectedDot> dots,
                                 const PlaneFromImage& grid_from_image, Grid& grid,
                                 int min_side = kWindowSide);

/// Returns the quality |P^(x) P^(y)| of a cell, at most 127 * 127. The quality is high if the dot
/// is near one of the four dot positions of the cell.
inline int quality(const GridCell& cell) {
    const int product = cell.x * cell.y;
    return product < 0 ? -product : product;
}

}  // namespace dotpose::core

// Likelihood: how likely each bit of each dot is 1 or 0. Paper section II-B.4, eq. 7-9, Fig. 7-8.
#pragma once

#include "core/stages.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Returns the quasi-probability f(r) of eq. 9 for a projected offset in 2^-16 spacings, in 1/127,
/// in [-127, 127].
std::int8_t quasi_probability(std::int32_t projection_q16);

/// Empties the grid and lays it over the cells from `least` to `most`, or over the middle ones if
/// there are more than it holds.
void lay_out(Vec least, Vec most, Grid& grid);

/// Fills the matrices P of Fig. 8 from all dots. Of a larger grid only the middle `grid.side` cells
/// per axis are kept. Errors: grid_too_small.
Status assign_likelihoods(std::span<const Dot> dots, const PlaneFromImage& grid_from_image,
                          Grid& grid);

/// Fills the matrices from a grid without perspective and lens, which is faster.
Status assign_affine_likelihoods(std::span<const Dot> dots, const PlaneFromImage& grid_from_image,
                                 Grid& grid);

/// Returns |P^(x) P^(y)|, how clearly the cell's dot shows its symbol: at most 127 * 127.
inline int quality(const GridCell& cell) {
    const int product = cell.x * cell.y;
    return product < 0 ? -product : product;
}

}  // namespace dotpose::core

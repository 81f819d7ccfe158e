// Axes: the two directions and spacings of the grid, from symmetric edges. Paper section II-B.2,
// Fig. 5 (constrained k-means).
#pragma once

#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets u and v of the lattice, but not its origin. The lattice is right-handed: v is u rotated
/// from +x to +y. `memory` must contain two elements per edge. Errors: no_grid, if the edges do not
/// have two directions with about equal lengths and about a right angle between them.
Status estimate_axes(std::span<const SeedEdge> edges, std::span<std::int32_t> memory,
                     Lattice& lattice);

/// Returns true if the vectors may be the axes of a square grid at a tilt of up to about 35
/// degrees.
bool is_nearly_square(FixedVec u, FixedVec v);
/// Returns true if the grid at the centre of a plane may be a square grid with a spacing of at
/// least 4 px.
bool is_nearly_square(const PlaneFromImage& plane);

}  // namespace dotpose::core

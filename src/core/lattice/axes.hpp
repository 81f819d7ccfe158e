// Axes: the two directions and spacings of the grid, estimated from the symmetric edges between
// dots. Paper section II-B.2, Fig. 5 (constrained k-means).
#pragma once

#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets u and v of the lattice, but not its origin. v is u rotated by 90 degrees from +x to +y.
/// `memory` must contain two elements per edge. Errors: no_grid, if there are fewer than 12 edges,
/// if every edge extends over 128 px or more along an axis, or if the edges do not have two
/// approximately perpendicular directions with approximately equal lengths.
Status estimate_axes(std::span<const SeedEdge> edges, std::span<std::int32_t> memory,
                     Lattice& lattice);

/// Returns true if u and v may be the axes of a square grid seen by a tilted camera. The ratio of
/// their lengths must be at most 3:2. The sine of the angle from u to v, measured from +x towards
/// +y, must be at least 0.9.
bool is_nearly_square(FixedVec u, FixedVec v);
/// Returns true if the axes of the grid at the centre of a plane are nearly square (see the
/// overload for two vectors), and the spacing along u is at least 4 px.
bool is_nearly_square(const PlaneFromImage& plane);

}  // namespace dotpose::core

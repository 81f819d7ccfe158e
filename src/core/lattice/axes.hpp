// Axes: the two directions and spacings of the grid, from the symmetric edges between dots. Paper
// section II-B.2, Fig. 5 (constrained k-means).
#pragma once

#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets u and v of the lattice, but not its origin. v is u rotated by 90 degrees from +x to +y.
/// `memory` must contain two elements per edge. Errors: no_grid, if there are fewer than 12 edges,
/// if all edges extend over 128 px or more along an axis, or if the edges do not have two
/// directions with about equal lengths and about a right angle between them.
Status estimate_axes(std::span<const SeedEdge> edges, std::span<std::int32_t> memory,
                     Lattice& lattice);

/// Returns true if u and v may be the axes of a tilted square grid: the ratio of their lengths is
/// at most 3:2, and the angle from u to v, in the direction from +x to +y, has a sine of at least
/// 0.9.
bool is_nearly_square(FixedVec u, FixedVec v);
/// Returns true if the axes of the grid at the centre of a plane are nearly square (see the
/// overload for two vectors), and the spacing along u is at least 4 px.
bool is_nearly_square(const PlaneFromImage& plane);

}  // namespace dotpose::core

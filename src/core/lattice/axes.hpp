// Axes: estimates the directions and spacings of the grid from symmetric edges between dots (paper,
// section II-B.2 and figure 5).
#pragma once

#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets the axes u and v of the lattice, but not its origin. v is u rotated by 90 degrees, in the
/// direction from +x to +y. `memory` must contain two elements per edge. Divides the edges into two
/// clusters, one for each axis. Returns no_grid if:
/// - there are fewer than 12 edges,
/// - every edge extends 128 px or more along x or y, or
/// - the medians of the two clusters fail `is_nearly_square`.
Status estimate_axes(std::span<const SeedEdge> edges, std::span<std::int32_t> memory,
                     Lattice& lattice);

/// Returns true if u and v may be the axes of a square grid seen by a tilted camera: their lengths
/// differ by a factor of at most 1.5, and the sine of the angle from u to v is at least 0.9. Angles
/// increase from +x towards +y.
bool is_nearly_square(FixedVec u, FixedVec v);
/// Returns true if the grid axes at the centre of a plane are nearly square and the spacing along u
/// is at least 4 px.
bool is_nearly_square(const PlaneFromImage& plane);

}  // namespace dotpose::core

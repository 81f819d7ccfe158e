// Axes: the two directions and spacings of the grid, from the symmetric edges. Paper section
// II-B.2, Fig. 5 (constrained k-means).
#pragma once

#include "core/stages.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Sets u and v (right-handed: from u to v is the turn from +x to +y); the origin is not touched.
/// `memory` holds two values for each edge. Errors: no_grid, when the edges have no two directions
/// of about one length at a right angle.
Status estimate_axes(std::span<const Edge> edges, std::span<std::int32_t> memory, Lattice& lattice);

/// Whether two directions may belong to a square grid that is seen from up to about 35 degrees
/// aside.
bool is_nearly_square(Vec u, Vec v);
/// The same for the grid around the centre of a plane, with spacings of at least 4 px.
bool is_nearly_square(const PlaneFromImage& plane);

}  // namespace dotpose::core

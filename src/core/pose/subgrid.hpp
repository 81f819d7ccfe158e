// Subgrid: the place of the reference point between the intersections, and the angle. Implements
// paper section II-B.8, eq. 10-12, and the angle at the end of II-B.6.
#pragma once

#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Returns the plane of the grid, rotated upright. The origin of the result is `Decoding::place`.
PlaneFromImage upright_plane(const PlaneFromImage& grid_from_image, QuarterTurn pattern_from_grid);

/// Writes the plane, its place, and the position, section, angle and spacing at the reference point
/// into the fix.
void write_pose(const PlaneFromImage& pattern_from_image, FixedVec reference_q8, CodeVariant code,
                const Place& place, Fix& fix);

/// Faster variant of `write_pose` for a plane that has neither perspective nor lens terms.
void write_affine_pose(const PlaneFromImage& pattern_from_image, FixedVec reference_q8,
                       CodeVariant code, const Place& place, Fix& fix);

}  // namespace dotpose::core

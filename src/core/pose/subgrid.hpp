// Subgrid: computes the angle (paper, end of section II-B.6), and the position of the reference
// point to a fraction of a cell (paper, section II-B.8, equations 10-12).
#pragma once

#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Returns the plane of the grid after rotation to the upright orientation of the pattern. The
/// origin of the pattern coordinates is at `Decoding::place`.
PlaneFromImage upright_plane(const PlaneFromImage& grid_from_image, QuarterTurn pattern_from_grid);

/// Sets the plane of the fix, and the place of the plane's origin. Also sets the position, section,
/// angle and spacing at the reference point.
void write_pose(const PlaneFromImage& pattern_from_image, FixedVec reference_q8, CodeVariant code,
                const Place& place, Fix& fix);

/// Faster variant of `write_pose` for planes without perspective or lens terms.
void write_affine_pose(const PlaneFromImage& pattern_from_image, FixedVec reference_q8,
                       CodeVariant code, const Place& place, Fix& fix);

}  // namespace dotpose::core

// Origin: finds the origin of the first grid (paper, section II-B.2). The paper requires an intact
// neighbourhood of 3 x 3 dots, which is rare if dots are displaced or missing. This stage instead
// computes the origin from many dots near the centre. The origin along each axis is the circular
// mean of the offsets of these dots from the grid.
#pragma once

#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets the lattice origin near the point `near_q8`. Uses only the dots listed in `seeds` (by
/// index) that are within a few cells of this point. The lattice vectors must already be set.
void find_origin(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                 FixedVec near_q8, Lattice& lattice);

}  // namespace dotpose::core

// Origin: where the intersections of the first grid lie. Paper section II-B.2. differs: the paper
// takes a dot whose eight neighbours are all connected as they should; displaced and missing dots
// leave few of those, so here the phase of all dots near the centre is taken, as in a Fourier
// transform.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Sets the origin of the lattice, near a point, from the dots within a few cells of it.
void find_origin(std::span<const Dot> dots, std::span<const std::uint16_t> seeds, Vec near_q8,
                 Lattice& lattice);

}  // namespace dotpose::core

// Origin: finds the origin of the first grid. Paper section II-B.2. Differs: the paper uses a dot
// that is connected to all its eight neighbours. If dots are displaced or missing, few dots meet
// this condition. This implementation computes the origin from the mean phase of all dots near the
// centre, as in a Fourier transform.
#pragma once

#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Sets the origin of the lattice near the point `near_q8`, from the seeds within a few cells of
/// this point.
void find_origin(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                 FixedVec near_q8, Lattice& lattice);

}  // namespace dotpose::core

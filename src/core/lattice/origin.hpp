// Origin: the centre of an intact 3 x 3 neighbourhood near the middle of the image. Paper section
// II-B.2, Fig. 3.
#pragma once

#include "dotpose/status.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Sets `lattice.origin_q16` and the seed it was found at.
/// Errors: no_intact_neighbourhood.
Status find_origin(std::span<const Dot> dots, std::span<const std::uint16_t> seeds,
                   std::span<const std::array<std::int16_t, 4>> neighbours, Vec centre_q8,
                   Lattice& lattice, int& origin_seed);

}  // namespace dotpose::core

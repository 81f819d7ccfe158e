// Periodogram search: finds the grid from the dots' periodogram, for frames in which many dots are
// missing or false. Where neighbours mislead, all dots near the centre together still favour the
// true spacing and direction. differs: the second attempt only; docs/differs-from-paper.md.
#pragma once

#include "core/stages.hpp"

namespace dotpose::core {

/// Improves u and v, taken as a square grid, by maximising |F(k)|^2 + |F(k')|^2 over the seeds'
/// centres, where k and k' are the wave vectors of the grid's two directions. The search starts
/// from the first estimate, which may be turned by up to `most_turn_deg` to either side; the origin
/// follows from the phases of F. (Periodograms: Press et al., Numerical Recipes, 13.4.)
void search_periodogram(std::span<const Dot> dots, std::span<const std::uint16_t> seeds,
                        Vec centre_q8, int most_turn_deg, Lattice& lattice);

}  // namespace dotpose::core

// Periodogram search: finds the grid from the periodogram of the dots, for frames with many missing
// or false dots. False neighbours mislead the estimate of the axes from edges, but the sum over all
// dots near the centre still has its maximum at the true spacing and direction. differs: used in
// the second attempt only; docs/differs-from-paper.md.
#pragma once

#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Refines u and v, as a square grid, by maximising |F(k)|^2 + |F(k')|^2 over the centres of the
/// seeds, where k and k' are the wave vectors of the two directions of the grid. The first estimate
/// may be turned by up to `max_turn_deg` to either side. The origin follows from the phases of F.
/// (Periodograms: Press et al., Numerical Recipes, 13.4.)
void search_periodogram(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                        FixedVec centre_q8, int max_turn_deg, Lattice& lattice);

}  // namespace dotpose::core

// Periodogram search: finds the grid from the periodogram of the dots, for frames with many missing
// or false dots. In these frames, axes estimated from edges are unreliable, because many edges
// connect false neighbours. The periodogram is a sum over all dots near the centre, and still has
// its maximum at the true spacing and direction. Differs: the paper has no such step. Only the
// second attempt uses the periodogram. See docs/differs-from-paper.md.
#pragma once

#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Refines u and v by maximising |F(k)|^2 + |F(k')|^2, where k and k' are the wave vectors of the
/// two directions of the grid, and F is the Fourier transform of the centres of the seeds. First
/// searches for a square grid. Then searches for each direction separately, because the camera may
/// be tilted. The direction of the first estimate may be wrong by up to `max_turn_deg`. Sets the
/// origin from the phases of F. (Periodograms: Press et al., Numerical Recipes, 13.4.)
void search_periodogram(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                        FixedVec centre_q8, int max_turn_deg, Lattice& lattice);

}  // namespace dotpose::core

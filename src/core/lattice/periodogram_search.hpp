// Periodogram search: finds the grid in frames with many missing or false dots. In such frames,
// many edges (connections between neighbouring dots) connect false neighbours, so axes computed
// from the edges are unreliable. The periodogram is a sum over all dots near the centre, so its
// maximum is still at the true spacing and direction. Only the second attempt uses this search,
// which is not part of the paper (see docs/differs-from-paper.md).
#pragma once

#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Refines the grid vectors u and v of `lattice` by maximising |F(k)|^2 + |F(k')|^2, where F is the
/// Fourier transform of the seed centres, and k and k' are the wave vectors in the two grid
/// directions. Searches for a square grid first, and then for each direction separately, because
/// the camera may be tilted. The initial direction of u may be wrong by up to `max_turn_deg`. Sets
/// the origin from the phases of F. Source: Press et al., Numerical Recipes, 13.4.
void search_periodogram(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                        FixedVec centre_q8, int max_turn_deg, Lattice& lattice);

}  // namespace dotpose::core

/// Grids of bits with random errors, handed to the decoder without an image.
#pragma once

#include "integrity_tally.hpp"

namespace dotpose {

enum class GridKind : std::uint8_t {
    any,
    doubtful,  ///< with as many errors as make p_wrong land between 1e-3 and 1e-5
};

/// Draws grid `index` of a run, reads it and counts it. Pure and thread-safe.
void try_grid(GridKind kind, std::uint64_t seed, std::uint64_t index, Tally& tally);

}  // namespace dotpose

/// Tests the decoder with grids of bits that have random errors, without an image.
#pragma once

#include "integrity_tally.hpp"

namespace dotpose::tables {

enum class GridKind : std::uint8_t {
    any,
    doubtful,  ///< with so many errors that p_wrong is between 1e-3 and 1e-5
};

/// Draws grid `index` of a run, reads it and counts the result. Thread-safe.
void try_grid(GridKind kind, std::uint64_t seed, std::uint64_t index, IntegrityTally& tally);

}  // namespace dotpose::tables

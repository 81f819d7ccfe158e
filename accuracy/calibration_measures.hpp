// What `dotpose_calibration` measures; each prints a table in Markdown.
#pragma once

#include <cstdint>
#include <string>

#include "counting.hpp"

namespace dotpose {

/// Parameters of a lens, residuals, and positions located afterwards.
void measure_lenses(std::uint64_t small_cameras, std::uint64_t large_cameras,
                    const Counting& counting);

/// The reference point of robots that turn on the spot.
void measure_spins(std::uint64_t count, const Counting& counting);

/// Four sheets that lie side by side, printed to different scales.
void measure_stitching(std::uint64_t count, const Counting& counting);

/// Writes the frames of which docs/calibration.md shows what `dotpose calibrate` makes.
void write_example(const std::string& folder, std::uint64_t seed);

}  // namespace dotpose

// The measurements of `dotpose_calibration`, each of which prints a table in Markdown.
#pragma once

#include <cstdint>
#include <string>

#include "counting.hpp"

namespace dotpose {

/// Measures the parameters of lenses, the residuals, and positions located afterwards.
void measure_lenses(std::uint64_t small_cameras, std::uint64_t large_cameras,
                    const Counting& counting);

/// Measures the reference point of robots that turn on the spot.
void measure_spins(std::uint64_t count, const Counting& counting);

/// Measures the stitching of four sheets side by side that are printed to different scales.
void measure_stitching(std::uint64_t count, const Counting& counting);

/// Writes the frames of the example in docs/calibration.md.
void write_example(const std::string& folder, std::uint64_t seed);

}  // namespace dotpose

// Measure: measures the precise centres of all dots in the image, near the places that the code
// predicts. The second attempt needs these measurements, because its filter blurs the dots and its
// threshold misses some of the dots. Differs: docs/differs-from-paper.md.
#pragma once

#include "core/decode/grid.hpp"
#include "core/decode/nominal.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Replaces the dots by measured dots, one for each cell that has a dot at the predicted place, and
/// links the cells to these dots. Centres are Gaussian-windowed centroids (Bertin, SExtractor:
/// XWIN), iterated from the nominal places. The border of the image may crop the windows. Skips
/// hidden places, unlinks dots whose mass is not typical, and stops measuring when `dots` is full.
/// The mass of a dot is its peak darkness relative to the paper level, in units of 2^-14. Returns
/// the number of dots, including unlinked dots.
int measure_dots(const ImageView& image, const FixedLens& lens,
                 const PlaneFromImage& pattern_from_image, const Nominal& nominal, Grid& grid,
                 std::span<DetectedDot> dots);

}  // namespace dotpose::core

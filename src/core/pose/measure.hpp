// Measure: measures the precise centres of all dots, near their predicted places. The second
// attempt needs this stage, because it detects dots in a filtered image, where the dots are
// blurred, and the threshold misses some dots. Unlike the paper, this stage uses windowed
// centroids, up to the image border. See docs/differs-from-paper.md.
#pragma once

#include "core/decode/grid.hpp"
#include "core/decode/nominal.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Measures the predicted dot of each cell. Replaces `dots` by the measured dots, and links the
/// cells to them. Centres are Gaussian-windowed centroids (Bertin, SExtractor: XWIN), iterated from
/// the predicted places. Crops windows at the image border. Skips hidden places, and unlinks dots
/// with an untypical mass. Stops when `dots` is full. The mass of a dot is its peak darkness
/// relative to the paper level, in units of 2^-14. Returns the number of dots, including unlinked
/// dots.
int measure_dots(const ImageView& image, const FixedLens& lens,
                 const PlaneFromImage& pattern_from_image, const Nominal& nominal, Grid& grid,
                 std::span<DetectedDot> dots);

}  // namespace dotpose::core

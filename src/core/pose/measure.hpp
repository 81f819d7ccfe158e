// Measure: measures the precise centre of each dot near its predicted image position. The second
// attempt needs this stage, because its own detection uses a filtered image, in which dots are
// blurred and some dots are missed. Unlike the paper, this stage uses windowed centroids, and
// measures dots up to the image border. See docs/differs-from-paper.md.
#pragma once

#include "core/decode/grid.hpp"
#include "core/decode/nominal.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Measures the predicted dot of each cell. Overwrites `dots`, and sets `GridCell::dot` for every
/// cell. The value is kNoDot if graphics hide the predicted dot, if there is no dot near the
/// predicted position, or if `dots` is full.
///
/// Centres are Gaussian-windowed centroids (Bertin, SExtractor: XWIN), iterated from the predicted
/// positions. Windows are cropped at the image border. The mass of a dot is its peak darkness
/// relative to the paper level, in units of 2^-14. If the mass of a dot is not typical, the dot
/// remains in `dots`, but the `GridCell::dot` of its cell is kNoDot.
///
/// Returns the number of dots in `dots`.
int measure_dots(const ImageView& image, const FixedLens& lens,
                 const PlaneFromImage& pattern_from_image, const Nominal& nominal, Grid& grid,
                 std::span<DetectedDot> dots);

}  // namespace dotpose::core

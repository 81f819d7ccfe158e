// Measure: the exact centres of all dots from the image, once the code tells where to look. Used by
// the second attempt, whose filter and threshold blur and miss dots.
// differs: docs/differs-from-paper.md.
#pragma once

#include "core/decode/nominal.hpp"
#include "core/stages.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Replaces the dots by measured ones, one for each cell that shows a dot in its place, and links
/// the cells to them. Centres are Gaussian-windowed centroids (Bertin, SExtractor: XWIN), iterated
/// from the nominal places, in windows that the image's border may cut. Masses are darkness over
/// light, in 2^-14. Returns the number of dots.
int measure_dots(const ImageView& image, const Lens& lens, const PlaneFromImage& pattern_from_image,
                 const Nominal& nominal, Grid& grid, std::span<Dot> dots);

}  // namespace dotpose::core

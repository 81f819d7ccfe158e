// Sample cells: samples the bits of every cell from the image, at the four places of the cell. Dots
// contribute even if they were not found as blobs. In the second attempt, this stage replaces the
// projections of eq. 7-8. differs: docs/differs-from-paper.md.
#pragma once

#include "core/decode/grid.hpp"
#include "core/detect/paper.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Extends the grid over the whole image and sets the weights of the bits of all its cells, or of
/// the middle `grid.side` cells along each axis. Places outside the image and under graphics favour
/// neither value of a bit, and cells under graphics are marked as hidden. Cells near graphics or
/// the border have smaller weights. Returns false if many cells contain two dots, which means that
/// the image contains two patterns.
bool sample_cells(const ImageView& image, const PaperMap& paper, const FixedLens& lens,
                  const PlaneFromImage& grid_from_image, Grid& grid);

}  // namespace dotpose::core

// Sample cells: reads the bits of each cell from the grey levels at its four possible dot
// positions. In the second attempt, this stage replaces the projections of dot offsets (paper,
// equations 7 and 8). Unlike the projections, it can use dots that blob detection missed. See
// docs/differs-from-paper.md.
#pragma once

#include "core/decode/grid.hpp"
#include "core/detect/paper.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Extends the grid over the whole image, up to `grid.side` cells per axis, and sets all bit
/// weights. Dot positions outside the image or under graphics favour neither bit value. Marks cells
/// with dot positions under graphics as hidden. Reduces the weights at the image border, near
/// graphics and in dirty cells. Returns false if more than 3/8 of the completely visible cells seem
/// to contain two dots, because the image then probably shows two patterns.
bool sample_cells(const ImageView& image, const PaperMap& paper, const FixedLens& lens,
                  const PlaneFromImage& grid_from_image, Grid& grid);

}  // namespace dotpose::core

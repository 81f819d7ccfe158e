// Sample cells: reads the bits of every cell from the grey levels at the four places of the cell.
// Dots contribute even if blob detection missed them. In the second attempt, this stage replaces
// the projections of eq. 7-8. Differs: docs/differs-from-paper.md.
#pragma once

#include "core/decode/grid.hpp"
#include "core/detect/paper.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Extends the grid over the whole image, up to `grid.side` cells along each axis, and sets the
/// weights of the bits of all its cells. Places outside the image and under graphics favour neither
/// value of a bit. Cells with places under graphics are marked as hidden. Cells at the border, near
/// graphics, or with dirt have smaller weights. Returns false if more than 3/8 of the completely
/// visible cells appear to contain two dots, which means that the image contains two patterns.
bool sample_cells(const ImageView& image, const PaperMap& paper, const FixedLens& lens,
                  const PlaneFromImage& grid_from_image, Grid& grid);

}  // namespace dotpose::core

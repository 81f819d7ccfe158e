// Look: the bits of every cell from the image itself, at the four places where its dot may be: a
// dot that was not found as a blob still has its say. Replaces the projections of eq. 7-8 in the
// second attempt. differs: docs/differs-from-paper.md.
#pragma once

#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Lays the grid over the whole image and sets the weights of the bits of all its cells, or of the
/// middle `grid.side` ones per axis. Cells near the border stay without; places under
/// graphics count as neither dark nor light, and their cells are marked as hidden.
void look_at_cells(const ImageView& image, const PaperMap& paper, const Lens& lens,
                   const PlaneFromImage& grid_from_image, Grid& grid);

}  // namespace dotpose::core

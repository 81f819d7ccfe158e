// Sample cells: the bits of every cell from the image itself, at the four places where its dot may
// be, so that dots count that were not found as blobs. Replaces the projections of eq. 7-8 in the
// second attempt. differs: docs/differs-from-paper.md.
#pragma once

#include "core/stages.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Lays the grid over the whole image and sets the weights of the bits of all its cells, or of the
/// middle `grid.side` ones per axis. Places outside the image and under graphics count as neither
/// dark nor light; cells under graphics are marked as hidden. Cells that are not in plain view
/// weigh less. Returns false if many cells show two dots: the image shows two patterns.
bool sample_cells(const ImageView& image, const PaperMap& paper, const Lens& lens,
                  const PlaneFromImage& grid_from_image, Grid& grid);

}  // namespace dotpose::core

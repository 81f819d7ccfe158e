// Look: the bits of every cell from the image itself, at the four places where its dot may be: a
// dot that was not found as a blob still has its say. Replaces the projections of eq. 7-8 in the
// second attempt. differs: docs/differs-from-paper.md.
#pragma once

#include "dotpose/image.hpp"
#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Sets the weights of the bits of all cells of the grid that lie within the image; the dots found
/// in them are kept for the pose.
void look_at_cells(const ImageView& image, const PlaneFromImage& grid_from_image, Grid& grid);

}  // namespace dotpose::core

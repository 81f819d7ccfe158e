// Patch: places the patch that is searched for the grid, sets its thresholds, and removes minima
// that are not dots. Paper section II-B.1.
#pragma once

#include "core/patch_memory.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Places a patch of the given size, in px of the image, around a point of the image. Limits the
/// size of the patch to the size of the image and to the capacity of `Patch`, and shifts the patch
/// into the image. Each pixel of the patch covers `scale` x `scale` pixels of the image. `scale`
/// must be 1, 2 or 4. Returns false if a side of the resulting patch is shorter than
/// `Patch::min_side_px`, in px of the patch.
bool place_patch(const ImageView& image, int centre_u_px, int centre_v_px, int width_px,
                 int height_px, int scale, Patch& patch);

/// Measures the typical contrast of the dots of a smoothed patch, and computes the threshold of
/// each tile from this contrast and the paper level of the tile. Returns false if too few tiles
/// have contrast.
bool measure_contrast(Patch& patch);

/// Removes minima that are not dots: minima on plateaus, minima in tiles without contrast, and
/// minima whose surroundings are dark in more than two of eight directions, such as minima on a
/// dark table beyond the edge of the sheet.
void keep_isolated(Patch& patch);

/// Return the coordinates of the middle of the patch, in px of the image.
float middle_u_px(const Patch& patch);
float middle_v_px(const Patch& patch);

}  // namespace dotpose::core

// Patch: the part of an image in which the grid is searched, and its thresholds. Paper section
// II-B.1.
#pragma once

#include "core/patch_memory.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Places a patch of the given size in px around a point of the image, cut to the image and to the
/// patch's memory, and reduced by `scale`: 1, 2 or 4. Returns false if too little is left to show a
/// grid.
bool place_patch(const ImageView& image, int centre_u_px, int centre_v_px, int width_px,
                 int height_px, int scale, Patch& patch);

/// Sets the thresholds of the tiles of a smoothed patch from the paper's level in each and the
/// typical darkness of dots. Returns false if hardly any tile has something dark.
bool measure_contrast(Patch& patch);

/// Drops minima that are noise: those whose surroundings are dark in more than two of eight
/// directions, as on a dark table beyond the edge of a sheet, those in tiles without contrast, and
/// those on plateaus.
void keep_isolated(Patch& patch);

/// Return the middle of the patch, in px of the image.
float middle_u_px(const Patch& patch);
float middle_v_px(const Patch& patch);

}  // namespace dotpose::core

// Patch: the part of an image in which the grid is looked for, and the light in it. Paper section
// II-B.1.
#pragma once

#include "core/patch_memory.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// A patch of so many px of the image around one of its points, as far as the image and the patch's
/// memory reach, reduced by `scale`: 1, 2 or 4. False if too little is left to show a grid.
bool place_patch(const ImageView& image, int centre_u_px, int centre_v_px, int width_px,
                 int height_px, int scale, Patch& patch);

/// Sets the thresholds of the tiles of a smoothed patch from the paper's level in each, and from
/// how much darker dots are in most of them. False if hardly a tile has anything dark.
bool measure_contrast(Patch& patch);

/// Drops minima of noise on a dark table: those that are dark as well a little way off in more than
/// two of eight directions, as beyond the edge of a sheet, those in tiles without contrast, and
/// those of plateaus.
void keep_isolated(Patch& patch);

/// The middle of the patch, px of the image.
float middle_u_px(const Patch& patch);
float middle_v_px(const Patch& patch);

}  // namespace dotpose::core

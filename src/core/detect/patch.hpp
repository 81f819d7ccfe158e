// Patch: the part of an image that is searched for the grid. Places the patch, computes its
// thresholds, and removes minima that are not dots (paper, section II-B.1).
#pragma once

#include <cstdint>

#include "core/patch_memory.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Places a patch around an image point. The requested size is in image pixels. Each pixel of the
/// patch covers `scale` x `scale` image pixels, and `scale` is 1, 2 or 4. The patch is shifted into
/// the image and clipped to the capacity of `Patch`. Returns false if a side has fewer than
/// `Patch::min_side_px` patch pixels.
bool place_patch(const ImageView& image, int centre_u_px, int centre_v_px, int width_px,
                 int height_px, int scale, Patch& patch);

/// Selects the tile whose darkness is used as the dot contrast of the whole patch.
enum class DotTiles : std::uint8_t {
    median,  ///< the tile with the median darkness among all tiles with contrast
    /// A pale tile, for patches in which most tiles contain graphics. Blurred dots are paler than
    /// graphics of the same ink.
    pale,
};

/// Measures the typical dot contrast in a smoothed patch. Computes each tile's threshold from this
/// contrast and the tile's paper level. Returns false if too few tiles have contrast, or if
/// `tiles` is `pale` and the pale tiles are nearly as dark as the median tile.
bool measure_contrast(Patch& patch, DotTiles tiles = DotTiles::median);

/// Removes minima that are not dots: minima on plateaus, minima in tiles without contrast, and
/// minima that are surrounded by dark pixels in more than two of eight directions, for example on a
/// dark table beyond the sheet.
void keep_isolated(Patch& patch);

/// Returns the u coordinate of the middle of the patch, in image pixels. `middle_v_px` returns the
/// v coordinate.
float middle_u_px(const Patch& patch);
float middle_v_px(const Patch& patch);

}  // namespace dotpose::core

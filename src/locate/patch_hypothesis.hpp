// Patch hypothesis: finds the grid in a patch and its place in the code. Shared by the first
// attempt and the search for a rotation.
#pragma once

#include <optional>

#include "core/detect/patch.hpp"
#include "core/lattice/outwards.hpp"
#include "core/patch_memory.hpp"
#include "dotpose/fix.hpp"
#include "locate/frame.hpp"
#include "locate/hypothesis.hpp"
#include "locate/place_evidence.hpp"

namespace dotpose::core {

/// Moves the dots to their undistorted image points. The coordinates of the dots are relative to
/// `middle`, which is in px relative to the image centre. Does nothing if the lens has no
/// distortion.
void undistort(const FixedLens& lens, FloatVec middle, PatchDots& dots);

/// Returns the centre of a patch, in px relative to the image centre.
FloatVec middle_of(const Patch& patch, const ImageView& image);

/// Places a patch around the image point `around_px`. The patch is `scale` times as wide and as
/// high as the smallest patch, at 1/`scale` of the resolution. Returns false if the patch is too
/// small for a grid.
bool place_patch(const ImageView& image, FixedVec around_px, int scale, Patch& patch);

/// Places a patch around the image centre. Returns false if the patch is too small for a grid.
bool place_patch_in_middle(const ImageView& image, int scale, Patch& patch);

/// Finds the dots of the patch. Sets the status of the fix to too_few_dots if no patch so far has
/// had at least `Frame::min_dots` dots, and to no_grid otherwise. A later fix replaces this status.
/// Returns false without setting the status if the patch has no contrast.
bool find_patch_dots(const Frame& frame, Patch& patch, Fix& fix, DotTiles tiles = DotTiles::median);

/// Finds a place in the code from the dots and the grid of a patch. The dots, the grid and the
/// hypothesis are relative to `from_centre`. `PlaceSearch::thorough` has an effect only if the grid
/// is probably correct and the patch has few dots, because a thorough search takes a long time.
/// Returns nullopt if no place is found.
std::optional<Hypothesis> read_grid(const Patch& patch, const PatchGrid& grid, FloatVec from_centre,
                                    const PlaceEvidence& evidence, PlaceSearch search);

/// Finds a grid in the dots of a patch, and then its place in the code with a brief search (see
/// `read_grid`). Returns nullopt if no grid or no place is found.
std::optional<Hypothesis> read_hypothesis(const Patch& patch, const PatchView& view,
                                          FloatVec from_centre, const PlaceEvidence& evidence);

}  // namespace dotpose::core

// Blobs: groups of dark pixels that touch, their centroids weighted by darkness, and the choice of
// those that are dots. Paper section II-B.1.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// The dots found so far.
struct DotList {
    std::span<Dot> dots;
    int& count;
    int& kept_within_px;  ///< distance from the image centre, per axis, within which dots are kept
};

/// Starts the blobs of a frame, with no dots.
void begin_blobs(const Light& light, OpenBlobs& open, DotList list);

/// Thresholds row `v` with `light.half_low_levels` and `light.high_levels`, continues the blobs of
/// the row above, and adds those that ended there to the list.
void grow_blobs(int v, const Light& light, OpenBlobs& open, DotList list);

/// Drops dots that are much lighter or larger than the upper quartile, and those of too few pixels.
/// Paper section II-B.1 ("only blobs with sufficient pixels are retained"); the limits are relative
/// to the other dots, so that they fit any spacing.
void sift_dots(const BlobOptions& options, DotList list);

}  // namespace dotpose::core

// Blobs: connected dark pixels and their centroids weighted by darkness, and the selection of dots
// among them. Paper section II-B.1.
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
void begin_blobs(const AdaptiveThreshold& threshold, OpenBlobs& open, DotList list);

/// Thresholds row `v` with `threshold.half_low_levels` and `threshold.high_levels`, continues the
/// blobs of the row above, and adds the blobs that ended there to the list.
void grow_blobs(int v, const AdaptiveThreshold& threshold, OpenBlobs& open, DotList list);

/// Removes dots that are much lighter or larger than the upper quartile, and dots with too few
/// pixels. Paper section II-B.1 ("only blobs with sufficient pixels are retained"). The limits are
/// relative to the other dots and suit any spacing.
void sift_dots(const BlobOptions& options, DotList list);

}  // namespace dotpose::core

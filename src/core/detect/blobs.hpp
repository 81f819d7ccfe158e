// Blobs: dark pixels that touch, their grey-weighted centres, and which of them are dots.
// Paper section II-B.1.
#pragma once

#include "core/stages.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

struct DotList {
    std::span<Dot> dots;
    int& count;
    int& kept_within_px;  ///< of the image centre, per axis
};

void begin_blobs(const Light& light, OpenBlobs& open, DotList list);

/// Thresholds row `v` with `light.half_low_levels` and `light.high_levels`, continues the blobs of
/// the row above, and adds those that ended there to the list.
void grow_blobs(int v, const Light& light, OpenBlobs& open, DotList list);

/// The size filter: drops dots that are much lighter or larger than the median dot, and those of
/// too few pixels. Paper section II-B.1 ("only blobs with sufficient pixels are retained");
/// relative to the other dots, so that it fits any spacing.
void sift_dots(const BlobOptions& options, DotList list);

}  // namespace dotpose::core

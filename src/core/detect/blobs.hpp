// Blobs: connects dark pixels, computes centroids, and selects the dots (paper, section II-B.1).
// Unlike the paper, which uses the centres of mass of binary blobs, this stage weights pixels by
// their darkness.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/detect/adaptive_threshold.hpp"
#include "core/detect/runs.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// A blob that may continue in the next row, stored as sums over its pixels. The weight of a pixel
/// is the low threshold minus its grey level. The sums may wrap modulo 2^32. The centroid is still
/// exact, because it is computed from sums relative to the corner of the blob. These sums do not
/// wrap if the blob is small enough to be a dot.
struct OpenBlob {
    std::uint32_t sum_x = 0;  ///< sum of weight times u
    std::uint32_t sum_y = 0;  ///< sum of weight times v
    std::uint32_t mass = 0;
    std::uint32_t area_px = 0;
    std::uint16_t left = 0;
    std::uint16_t right = 0;  ///< exclusive
    std::uint16_t first_v = 0;
    std::uint16_t last_v = 0;
    /// The blob into which this blob was merged, or null. In an unused blob, this is the next
    /// unused blob.
    OpenBlob* part_of = nullptr;
    bool passes_high = false;  ///< true if a pixel is darker than the high threshold
};

/// The blobs that reach the newest row, and the runs of the two newest rows.
struct OpenBlobs {
    /// Runs of the newest row and the row above. Each half of the span contains one row, followed
    /// by a sentinel run.
    std::span<Run> runs;
    int run_count = 0;
    bool newest_in_second_half = false;
    /// Maximum number of runs per image. Further runs are ignored.
    int max_runs = INT32_MAX;
    int runs_left = 0;
    std::span<OpenBlob> blobs;
    std::size_t blobs_begun = 0;       ///< number of elements of `blobs` used so far in this image
    OpenBlob* first_unused = nullptr;  ///< first blob in the list of unused blobs, or null
};

/// The blobs found so far that may be dots.
struct DotList {
    std::span<DetectedDot> dots;
    int& count;
    int& kept_within_px;  ///< maximum distance of dots from the image centre, along each axis
};

/// Starts a new frame. Discards all blobs and dots.
void begin_blobs(const AdaptiveThreshold& threshold, OpenBlobs& open, DotList list);

/// Finds the runs of row `v`, and connects them to the open blobs. Closes the blobs that do not
/// continue in this row. Adds each closed blob that may be a dot to the list.
void grow_blobs(int v, const AdaptiveThreshold& threshold, OpenBlobs& open, DotList list);

/// Removes blobs with too few pixels, a mass far below the upper quartile, or an area far above the
/// upper quartile (paper, section II-B.1). Because the limits are relative to quartiles, they apply
/// to any spacing.
void sift_dots(const BlobOptions& options, DotList list);

}  // namespace dotpose::core

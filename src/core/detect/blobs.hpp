// Blobs: finds sets of connected dark pixels, computes their centroids weighted by darkness, and
// selects the dots among these blobs. Paper section II-B.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/detect/adaptive_threshold.hpp"
#include "core/detect/runs.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// A blob that may continue in the next row, represented by sums over its pixels. The sums are
/// computed modulo 2^32. For blobs that are small enough to be dots, the sums relative to the
/// corner of the blob are exact.
struct OpenBlob {
    std::uint32_t sum_x = 0;  ///< sum of weight times u
    std::uint32_t sum_y = 0;  ///< sum of weight times v
    std::uint32_t mass = 0;
    std::uint32_t area_px = 0;
    std::uint16_t left = 0;
    std::uint16_t right = 0;  ///< exclusive
    std::uint16_t first_v = 0;
    std::uint16_t last_v = 0;
    /// The blob into which this blob was merged, or null. For an unused blob, the next blob in the
    /// list of unused blobs.
    OpenBlob* part_of = nullptr;
    bool passes_high = false;  ///< true if a pixel is darker than the high threshold
};

/// The blobs that have pixels in the newest thresholded row, and the runs of this row.
struct OpenBlobs {
    /// Runs of the newest row and of the row above it. Each half of the span contains the runs of
    /// one row, followed by a sentinel run.
    std::span<Run> runs;
    int run_count = 0;
    bool newest_in_second_half = false;
    int max_runs = INT32_MAX;  ///< maximum number of runs per image; further runs are ignored
    int runs_left = 0;
    std::span<OpenBlob> blobs;
    std::size_t blobs_begun = 0;  ///< number of elements of `blobs` that this image has used so far
    OpenBlob* first_unused = nullptr;  ///< first blob in the list of unused blobs, or null
};

/// The blobs found so far that may be dots.
struct DotList {
    std::span<DetectedDot> dots;
    int& count;
    int& kept_within_px;  ///< distance from the image centre, per axis, within which dots are kept
};

/// Starts a new frame and discards all blobs and dots.
void begin_blobs(const AdaptiveThreshold& threshold, OpenBlobs& open, DotList list);

/// Finds the runs of row `v` with `threshold.half_low_levels` and `threshold.high_levels`, and
/// continues the blobs of the row above. Adds the blobs that ended in the row above to the list if
/// they may be dots.
void grow_blobs(int v, const AdaptiveThreshold& threshold, OpenBlobs& open, DotList list);

/// Removes blobs with too few pixels, with a mass far below the upper quartile of the masses, or
/// with an area far above the upper quartile of the areas. Paper section II-B.1 ("only blobs with
/// sufficient pixels are retained"). Limits relative to the upper quartiles are suitable for any
/// spacing.
void sift_dots(const BlobOptions& options, DotList list);

}  // namespace dotpose::core

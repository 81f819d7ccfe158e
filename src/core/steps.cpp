#include "core/steps.hpp"

#include <algorithm>

#include "core/decode/orientation.hpp"
#include "core/decode/window.hpp"
#include "core/detect/undistort.hpp"
#include "core/lattice/axes.hpp"
#include "core/lattice/neighbours.hpp"
#include "core/math/fixed.hpp"
#include "core/option_ranges.hpp"

namespace dotpose::core {
namespace {

DotList dot_list(Workspace& w) {
    return {w.dots, w.dot_count, w.dots_kept_within_px};
}

bool are_valid(const DeviceOptions& options) {
    return all_options(options, [](const char*, std::int32_t value, std::int32_t low,
                                   std::int32_t high) { return value >= low && value <= high; });
}

}  // namespace

Status check(int width_px, int height_px, const DeviceOptions& options, const Workspace& w) {
    if (!are_valid(options)) return Status::bad_argument;
    // Rejects images smaller than kMinFrameSide_px if only the second attempt would be made,
    // because this attempt requires sides of at least that length. With Decoder::window, only the
    // second attempt is made, unless the effort is `device`.
    const bool may_be_small = options.effort == Effort::device || options.decoder == Decoder::all;
    if (std::min(width_px, height_px) < (may_be_small ? w.min_side_px : kMinFrameSide_px))
        return Status::image_too_small;
    if (width_px > w.max_width_px || height_px > w.max_height_px) return Status::image_too_large;
    return Status::ok;
}

Status check(const ImageView& image, const DeviceOptions& options, const Workspace& w) {
    const Status status = check(image.width_px, image.height_px, options, w);
    return status == Status::ok && image.pixels == nullptr ? Status::bad_argument : status;
}

const Fix& refuse(Status reason, Workspace& w) {
    forget_frame(w);
    w.fix.status = reason;
    return w.fix;
}

FixedVec image_centre_q8(const AdaptiveThreshold& threshold) {
    return {(threshold.width_px - 1) * 128, (threshold.height_px - 1) * 128};
}

FixedVec reference_q8(FixedVec centre_q8, const DeviceOptions& options) {
    return centre_q8 + FixedVec{options.reference_dx_q8, options.reference_dy_q8};
}

void forget_frame(Workspace& w) {
    w.fix = Fix{};
    w.dot_count = w.seed_count = w.edge_count = 0;
    w.lattice = {};
    w.decoding = {};
    w.grid.columns = w.grid.rows = 0;
}

void begin_frame(int width_px, int height_px, Workspace& w) {
    forget_frame(w);
    begin_threshold(width_px, height_px, w.threshold);
    begin_blobs(w.threshold, w.open, dot_list(w));
}

void threshold_bands(int ready, const DeviceOptions& options, Workspace& w) {
    ThresholdOptions threshold = options.threshold;
    threshold.min_contrast = std::max(threshold.min_contrast, options.min_contrast);
    const int newest = (w.threshold.rows_taken - 1) >> w.threshold.band_shift;
    const bool is_last = w.threshold.rows_taken == w.threshold.height_px;
    for (int band = newest - ready + (is_last ? 1 : 0); ready > 0; --ready, ++band) {
        const int before = w.threshold.max_contrast;
        measure_levels(band, threshold, w.threshold);
        // If the contrast of all earlier bands is below the new minimum, discards their dots as
        // noise.
        if (before < min_tile_contrast(threshold, w.threshold)) w.dot_count = 0;
        for (int v = band_begin(w.threshold, band); v < band_end(w.threshold, band); ++v) {
            grow_blobs(v, w.threshold, w.open, dot_list(w));
        }
    }
}

void detect_image(const ImageView& image, const DeviceOptions& options, Workspace& w) {
    begin_frame(image.width_px, image.height_px, w);
    for (int v = 0; v < image.height_px; ++v)
        detect_row(image.row(v), options, w);
}

Status find_dots(const DeviceOptions& options, Workspace& w) {
    sift_dots(options.blobs, dot_list(w));
    w.fix.dots_seen = w.dot_count;
    if (!w.threshold.has_contrast) return Status::no_contrast;
    // Requires at least one dot even if `min_dots` is 0, because later stages compute means over
    // the dots.
    if (w.dot_count < std::max(min_dots(options, w), 1)) return Status::too_few_dots;
    // Removes the lens distortion (paper, equations 1-2).
    undistort(options.lens, image_centre_q8(w.threshold), first(w.dots, w.dot_count));
    return Status::ok;
}

Status find_axes(FixedVec start_q8, int max_seeds, Workspace& w) {
    const auto dots = w.found_dots();
    const int room = std::min(max_seeds, static_cast<int>(w.seeds.size()));
    w.seed_count = choose_seeds(dots, start_q8, first(w.seeds, room));
    const std::span<const std::uint16_t> seeds = first(w.seeds, w.seed_count);
    // Finds the neighbours of each seed (paper, section II-B.2 and figure 3).
    find_neighbours(dots, seeds, w.buckets, w.neighbours);
    w.edge_count = connect_symmetric(dots, seeds, w.neighbours, w.edges);
    // Estimates the grid axes from the edges (paper, figures 4-5).
    return estimate_axes(first(w.edges, w.edge_count), w.edge_values, w.lattice);
}

void choose_region(Workspace& w) {
    w.decoding.region = choose_window(w.grid, static_cast<int>(w.line_scores.size() / 2));
}

Status refused(Status reason, const Workspace& w) {
    const Decoding& decoding = w.decoding;
    return is_mirrored(w.grid, decoding.region, decoding.agreement) ? Status::mirrored : reason;
}

}  // namespace dotpose::core

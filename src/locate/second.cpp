#include "locate/second.hpp"

#include <algorithm>

#include "core/decode/likelihood.hpp"
#include "core/decode/position.hpp"
#include "core/decode/sample_cells.hpp"
#include "core/decode/window.hpp"
#include "core/detect/smooth.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "core/lattice/periodogram_search.hpp"
#include "core/lattice/refine_grid.hpp"
#include "core/steps.hpp"
#include "locate/dot_reader.hpp"
#include "locate/fitted_pose.hpp"
#include "locate/on_sheets.hpp"
#include "locate/tracked.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::second;

/// Returns the options with thresholds for a filtered image.
DeviceOptions for_filtered(DeviceOptions options) {
    options.min_contrast = 0;  // applies only to the original image; see `is_pale`
    ThresholdOptions& threshold = options.threshold;
    threshold.min_contrast = threshold.min_contrast / 2 + 1;
    threshold.low_q8 = (tuned::kLow_3rds * threshold.low_q8 + 2) / 3;
    threshold.high_q8 = (tuned::kHigh_10ths * threshold.high_q8 + 9) / 10;
    return options;
}

/// Filters the image and detects its blobs.
void detect_filtered(const ImageView& image, const DeviceOptions& filtered, DesktopWorkspace& w) {
    begin_frame(image.width_px, image.height_px, w);
    begin_smoothing(image, w.smoothing);
    for (int v = 0; v < image.height_px; ++v)
        detect_row(next_smooth_row(image, w.smoothing), filtered, w);
}

/// Finds the grid, including perspective and lens distortion. Takes longer than `find_grid` in
/// device/attempt.cpp.
Status find_grid_thoroughly(const DeviceOptions& options, DesktopWorkspace& w) {
    const FixedVec centre_q8 = image_centre_q8(w.threshold);
    Status status = find_axes(centre_q8, kMaxSeeds, w);
    if (status != Status::ok) return status;
    const Lattice estimate = w.lattice;
    for (const int max_turn_deg : tuned::kMaxTurns_deg) {
        w.lattice = estimate;
        search_periodogram(w.found_dots(), first(w.seeds, w.seed_count), centre_q8, max_turn_deg,
                           w.lattice);
        status =
            refine_grid(w.found_dots(), options.lattice, centre_q8, w.lattice, w.grid_from_image);
        if (status != Status::no_grid) break;
    }
    return status;
}

/// Samples the bits at the grid cells. Returns false if the image shows two overlapping patterns.
bool shows_one_pattern(const ImageView& image, const DeviceOptions& options, DesktopWorkspace& w) {
    return sample_cells(image, w.smoothing.paper, options.lens, w.grid_from_image, w.grid);
}

Status decode(const DeviceOptions& options, DesktopWorkspace& w) {
    if (options.decoder == Decoder::window) {
        return decode_window(w.grid, options.code, w.line_scores, w.decoding);
    }
    return decode_all(w.grid, options.code, w.line_scores, w.decoding);
}

/// Finds the position from the bits, and verifies the position with the bits of all dots.
Status read_position(const DeviceOptions& options, DesktopWorkspace& w) {
    // Chooses the window (paper, section II-B.5).
    w.decoding.window = choose_window(w.grid, kWindowSide);
    choose_region(w);
    // Finds the orientation and the position (paper, sections II-B.6 and II-B.7).
    Status status = decode(options, w);
    if (status == Status::ok) {
        status = verify(kernels(), w.grid, options.code, wanted_codes(w), w.decoding,
                        options.integrity, w.line_scores, w.fix);
    }
    if (status == Status::ok && !is_possible(options.code, w)) status = Status::not_certain;
    if (status != Status::ok && w.known.any() && read_on_sheets(options, w)) status = Status::ok;
    return status == Status::ok ? status : refused(status, w);
}

/// Reads the bits again, with a grid fitted to the dots of a doubtful position. If the position is
/// correct, more bits are clear in the new grid.
Status resample(const ImageView& image, const DeviceOptions& options, DesktopWorkspace& w) {
    PoseFit fit;
    if (!fit_pattern(options, image, w, fit)) return Status::not_certain;
    w.grid_from_image = w.pattern_from_image;
    w.decoding.pattern_from_grid = {};
    w.decoding.p_wrong_log2_q8 = {};  // these values are for the previous bits
    return shows_one_pattern(image, options, w) ? read_position(options, w) : Status::not_certain;
}

/// Measures the dots again if the pixel bias matters. Uses the tracked attempt, because it corrects
/// the bias.
void measure_again_if_biased(const ImageView& image, const DeviceOptions& options,
                             DesktopWorkspace& w) {
    const float variance_px2 =
        w.fix.residual_px * w.fix.residual_px / static_cast<float>(w.fix.dots_used);
    if (may_be_biased(float_plane(w.pattern_from_image), variance_px2,
                      std::max(image.width_px, image.height_px))) {
        measure_again(kernels(), image, options, w);
    }
}

/// Finds dots and grid in the filtered image, and reads the bits (paper, sections II-B.1 to
/// II-B.4).
Status read_filtered_with(const DeviceOptions& filtered, const ImageView& image,
                          DesktopWorkspace& w) {
    detect_filtered(image, filtered, w);
    Status status = find_dots(filtered, w);
    if (status == Status::ok) status = find_grid_thoroughly(filtered, w);
    if (status == Status::ok) {
        status = assign_likelihoods(w.found_dots(), w.grid_from_image, w.grid);
    }
    if (status != Status::ok) return status;
    return shows_one_pattern(image, filtered, w) ? Status::ok : Status::not_certain;
}

/// Finds dots and grid, and reads the bits. If there is too little contrast or there are too few
/// dots, tries again with a lower minimum contrast, but only if the largest contrast in the image
/// reaches this minimum.
Status read_filtered(const ImageView& image, const DeviceOptions& options, DesktopWorkspace& w) {
    DeviceOptions filtered = for_filtered(options);
    filtered.lattice.min_dots = min_dots(options, w);
    const Status status = read_filtered_with(filtered, image, w);
    const int pale = (options.threshold.min_contrast + tuned::kPaleParts - 1) / tuned::kPaleParts;
    const bool may_be_pale = (status == Status::no_contrast || status == Status::too_few_dots) &&
                             w.threshold.max_contrast >= pale;
    if (!may_be_pale) return status;
    const Fix seen = w.fix;
    filtered.threshold.min_contrast = pale;
    if (read_filtered_with(filtered, image, w) == Status::ok) return Status::ok;
    // Keeps the first result. The second try found no readable grid, so its additional dots are
    // noise.
    w.fix = seen;
    w.dot_count = 0;
    return status;
}

/// Measures the pose at the decoded position (paper, section II-B.8). Also computes the odds of the
/// other codes, and corrects the pixel bias if this bias matters.
Status measure_and_weigh(const ImageView& image, const DeviceOptions& options,
                         DesktopWorkspace& w) {
    const Status status = measure_pose(options, image, w);
    w.fix.attempt = Attempt::second;
    if (status == Status::ok) {
        weigh_other_codes(kernels(), w.grid, options.code, w.decoding, w.line_scores,
                          wanted_codes(w));
        measure_again_if_biased(image, options, w);
    }
    return status;
}

}  // namespace

bool SecondAttempt::read(const DeviceOptions& options, Resampling resampling) {
    if (!is_seen_) {
        w_.fix.status = read_filtered(image_, options, w_);
        w_.fix.attempt = Attempt::second;
        seen_ = w_.fix;
        is_seen_ = true;
    }
    w_.fix = seen_;
    if (seen_.status != Status::ok) return false;
    w_.decoding = {};
    Status& status = w_.fix.status;
    status = read_position(options, w_);
    if (status == Status::not_certain && resampling == Resampling::if_doubtful) {
        status = resample(image_, options, w_);
        is_seen_ = false;
    }
    if (status != Status::ok) return false;
    status = measure_and_weigh(image_, options, w_);
    is_seen_ = false;  // the dots were measured again
    return status == Status::ok;
}

}  // namespace dotpose::core

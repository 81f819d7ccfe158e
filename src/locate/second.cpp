#include "locate/second.hpp"

#include <algorithm>

#include "core/decode/likelihood.hpp"
#include "core/decode/nominal.hpp"
#include "core/decode/position.hpp"
#include "core/decode/sample_cells.hpp"
#include "core/decode/window.hpp"
#include "core/detect/smooth.hpp"
#include "core/detect/undistort.hpp"
#include "core/integrity/verify.hpp"
#include "core/lattice/periodogram_search.hpp"
#include "core/lattice/refine_grid.hpp"
#include "core/pose/covariance.hpp"
#include "core/pose/measure.hpp"
#include "core/pose/refine_pose.hpp"
#include "core/pose/subgrid.hpp"
#include "core/pose/uneven.hpp"
#include "core/steps.hpp"
#include "locate/confirm.hpp"
#include "locate/dot_reader.hpp"
#include "locate/on_sheets.hpp"
#include "locate/trace.hpp"
#include "locate/tracked.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::second;

/// Returns the options of a frame, with thresholds for a filtered image.
DeviceOptions for_filtered(const Frame& frame) {
    DeviceOptions options = frame.options;
    options.min_contrast = 0;  // applies only to the original image; see `is_pale`
    options.lattice.min_dots = frame.min_dots;
    ThresholdOptions& threshold = options.threshold;
    threshold.min_contrast = threshold.min_contrast / 2 + 1;
    threshold.low_q8 = (tuned::kLow_3rds * threshold.low_q8 + 2) / 3;
    threshold.high_q8 = (tuned::kHigh_10ths * threshold.high_q8 + 9) / 10;
    return options;
}

/// Filters the image and detects its blobs.
void detect_filtered(const ImageView& image, const DeviceOptions& filtered, Smoothing& smoothing,
                     Workspace& w) {
    begin_frame(image.width_px, image.height_px, w);
    begin_smoothing(image, smoothing);
    for (int v = 0; v < image.height_px; ++v)
        detect_row(next_smooth_row(image, smoothing), filtered, w);
}

/// Finds the grid, including perspective and lens distortion. Takes longer than `find_grid` in
/// device/attempt.cpp.
Status find_grid_thoroughly(const DeviceOptions& options, FixedVec centre_q8, Workspace& w) {
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

Status decode(const DeviceOptions& options, const Grid& grid, std::span<ScoredLine> line_scores,
              Decoding& decoding) {
    if (options.decoder == Decoder::window)
        return decode_window(grid, options.code, line_scores, decoding);
    return decode_all(grid, options.code, line_scores, decoding);
}

/// Finds the position from the bits, and verifies the position with the bits of all dots.
Status read_position(const Frame& frame, const OtherCodes* others, Workspace& w) {
    const DeviceOptions& options = frame.options;
    // Chooses the window (paper, section II-B.5).
    w.decoding.window = choose_window(w.grid, kWindowSide);
    choose_region(w);
    // Finds the orientation and the position (paper, sections II-B.6 and II-B.7).
    Status status = decode(options, w.grid, w.line_scores, w.decoding);
    if (status == Status::ok) {
        status = verify(frame.kernels, w.grid, options.code, others, w.decoding, options.integrity,
                        w.line_scores, w.fix);
    }
    if (status == Status::ok && !is_possible(options.code, w.decoding, frame.known))
        status = Status::not_certain;
    if (status != Status::ok && frame.known.any() &&
        read_on_sheets(frame.kernels, options, w.grid, frame.known, w.decoding, w.fix))
        status = Status::ok;
    return status == Status::ok ? status : refused(status, w);
}

/// Measures the dots that the code predicts at the decoded position, and fits the map from image to
/// pattern. Returns false if the dots do not determine the map.
bool fit_pattern(const Frame& frame, const Nominal& nominal, const PaperMap& paper, Workspace& w,
                 PoseFit& fit) {
    const FixedLens& lens = frame.options.lens;
    w.pattern_from_image =
        upright_plane(w.grid_from_image, w.decoding.pattern_from_grid);  // paper, section II-B.8
    w.dot_count = measure_dots(frame.image, lens, w.pattern_from_image, nominal, w.grid, w.dots);
    undistort(lens, centre_q8(frame.image), first(w.dots, w.dot_count));
    w.seed_count = 0;  // seeds are indices of the previous dots
    const Observations observations(w.found_dots(), w.grid, nominal, &paper);
    return refine_pose(observations, w.pattern_from_image, fit);
}

/// Reads the bits again, with a grid fitted to the dots of a doubtful position. If the position is
/// correct, more bits are clear in the new grid.
Status resample(const Frame& frame, const PaperMap& paper, const OtherCodes* others, Workspace& w) {
    const Nominal nominal(w.grid, frame.options.code, w.decoding);
    PoseFit fit;
    if (!fit_pattern(frame, nominal, paper, w, fit)) return Status::not_certain;
    w.grid_from_image = w.pattern_from_image;
    w.decoding.pattern_from_grid = {};
    w.decoding.p_wrong_log2_q8 = {};  // these values are for the previous bits
    const bool shows_one_pattern =
        sample_cells(frame.image, paper, frame.options.lens, w.grid_from_image, w.grid);
    return shows_one_pattern ? read_position(frame, others, w) : Status::not_certain;
}

/// Measures the pose at the decoded position (paper, section II-B.8), and writes the pose and its
/// covariance into the fix. Errors: no_grid, not_certain.
Status measure_pose(const Frame& frame, const PaperMap& paper, MeasuredDots& memory, Workspace& w) {
    const Nominal nominal(w.grid, frame.options.code, w.decoding);
    PlaneFromImage& plane = w.pattern_from_image;
    PoseFit fit;
    if (!fit_pattern(frame, nominal, paper, w, fit)) return Status::no_grid;
    const FixedVec reference = reference_q8(centre_q8(frame.image), frame.options);
    fit_uneven(frame.kernels, {w.found_dots(), w.grid, nominal}, reference, memory, plane, fit);
    w.fix.displacement_q16 = static_cast<std::int32_t>(fit.displacement * 65536.0F);
    write_pose(plane, reference, frame.options.code, w.decoding.place, w.fix);
    estimate_covariance(fit, plane, reference, w.fix);
    return is_implausible(fit, w.decoding.bits, w.fix.bit_errors) ? Status::not_certain
                                                                  : Status::ok;
}

/// Returns true if the pixel bias of the fix matters. The tracked attempt corrects this bias.
bool may_be_biased(const Fix& fix, const PlaneFromImage& plane, const ImageView& image) {
    const float variance_px2 =
        fix.residual_px * fix.residual_px / static_cast<float>(fix.dots_used);
    return may_be_biased(float_plane(plane), variance_px2,
                         std::max(image.width_px, image.height_px));
}

/// Finds dots and grid in the filtered image, and reads the bits (paper, sections II-B.1 to
/// II-B.4).
Status read_filtered_with(const DeviceOptions& filtered, const ImageView& image,
                          Smoothing& smoothing, Workspace& w) {
    detect_filtered(image, filtered, smoothing, w);
    Status status = find_dots(filtered, w);
    if (status == Status::ok) status = find_grid_thoroughly(filtered, centre_q8(image), w);
    if (status == Status::ok)
        status = assign_likelihoods(w.found_dots(), w.grid_from_image, w.grid);
    if (status != Status::ok) return status;
    const bool shows_one_pattern =
        sample_cells(image, smoothing.paper, filtered.lens, w.grid_from_image, w.grid);
    return shows_one_pattern ? Status::ok : Status::not_certain;
}

/// Finds dots and grid, and reads the bits. If there is too little contrast or there are too few
/// dots, tries again with a lower minimum contrast, but only if the largest contrast in the image
/// reaches this minimum.
Status read_filtered(const Frame& frame, Smoothing& smoothing, Workspace& w) {
    DeviceOptions filtered = for_filtered(frame);
    const Status status = read_filtered_with(filtered, frame.image, smoothing, w);
    const int pale =
        (frame.options.threshold.min_contrast + tuned::kPaleParts - 1) / tuned::kPaleParts;
    const bool may_be_pale = (status == Status::no_contrast || status == Status::too_few_dots) &&
                             w.threshold.max_contrast >= pale;
    if (!may_be_pale) return status;
    const Fix seen = w.fix;
    filtered.threshold.min_contrast = pale;
    if (read_filtered_with(filtered, frame.image, smoothing, w) == Status::ok) return Status::ok;
    // Keeps the first result. The second try found no readable grid, so its additional dots are
    // noise.
    w.fix = seen;
    w.dot_count = 0;
    return status;
}

}  // namespace

bool SecondAttempt::read(const Frame& frame, Resampling resampling) {
    const PaperMap& paper = w_.smoothing.paper;
    const PlaceEvidence evidence = w_.evidence(frame);
    Status& status = w_.fix.status;
    if (!is_seen_) {
        status = read_filtered(frame, w_.smoothing, w_);
        w_.fix.attempt = Attempt::second;
        seen_ = w_.fix;
        is_seen_ = true;
    }
    w_.fix = seen_;
    if (status != Status::ok) return false;
    w_.decoding = {};
    status = read_position(frame, evidence.others, w_);
    if (status == Status::not_certain && resampling == Resampling::if_doubtful) {
        status = resample(frame, paper, evidence.others, w_);
        is_seen_ = false;
    }
    if (status != Status::ok) return false;
    is_seen_ = false;  // the dots are measured again
    status = measure_pose(frame, paper, w_.measurement.dots, w_);
    if (status != Status::ok) return false;
    weigh_other_codes(frame.kernels, w_.grid, frame.options.code, w_.decoding, w_.line_scores,
                      evidence.others);
    w_.measurement.bits = w_.decoding.bits;
    if (may_be_biased(w_.fix, w_.pattern_from_image, frame.image) &&
        measure_again(frame, evidence, w_.measurement, w_.fix))
        store_for_trace(w_.measurement, frame.options.show_stages, w_);
    return true;
}

}  // namespace dotpose::core

#include "locate/second.hpp"

#include <algorithm>

#include "core/decode/likelihood.hpp"
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

/// Returns the options of a frame, with the thresholds adapted to the filtered image.
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

Status decode(const DeviceOptions& options, const Grid& grid, std::span<ScoredLine> line_scores,
              Decoding& decoding) {
    if (options.decoder == Decoder::window)
        return decode_window(grid, options.code, line_scores, decoding);
    return decode_all(grid, options.code, line_scores, decoding);
}

/// Returns the place of the cell in the middle of the decoded region.
Place middle_place(CodeVariant code, const Decoding& decoding) {
    const GridRegion& region = decoding.region;
    const FixedVec middle =
        decoding.pattern_from_grid({region.i0 + region.columns / 2, region.j0 + region.rows / 2});
    return moved(code, decoding.place, middle.x, middle.y);
}

/// Returns true if the pixel bias of the fix may be significant. The dots are then measured again
/// in the same way as in the tracked attempt, which corrects the bias.
bool may_be_biased(const Fix& fix, const PlaneFromImage& plane, const ImageView& image) {
    const float variance_px2 =
        fix.residual_px * fix.residual_px / static_cast<float>(fix.dots_used);
    return may_be_biased(float_plane(plane), variance_px2,
                         std::max(image.width_px, image.height_px));
}

}  // namespace

/// Finds the grid of the detected dots. Allows for perspective, and for lens distortion that
/// remains in the dot centres.
Status SecondAttempt::find_grid(const LatticeOptions& options, FixedVec centre_q8) {
    Status status = find_axes(centre_q8, kMaxSeeds, w_);
    if (status != Status::ok) return status;
    const auto dots = w_.found_dots();
    const Lattice estimate = w_.lattice;
    for (const int max_turn_deg : tuned::kMaxTurns_deg) {
        w_.lattice = estimate;
        search_periodogram(dots, first(w_.seeds, w_.seed_count), centre_q8, max_turn_deg,
                           w_.lattice);
        status = refine_grid(dots, options, centre_q8, w_.lattice, w_.grid_from_image);
        if (status != Status::no_grid) break;
    }
    return status;
}

/// Filters the image, finds its dots and their grid, and reads the bits (paper, sections II-B.1 to
/// II-B.4). Returns not_certain if the image shows two overlapping patterns.
Status SecondAttempt::read_filtered_with(const DeviceOptions& filtered, const ImageView& image) {
    begin_frame(image.width_px, image.height_px, w_);
    begin_smoothing(image, w_.smoothing);
    for (int v = 0; v < image.height_px; ++v)
        detect_row(next_smooth_row(image, w_.smoothing), filtered, w_);
    Status status = find_dots(filtered, w_);
    if (status == Status::ok) status = find_grid(filtered.lattice, centre_q8(image));
    if (status == Status::ok)
        status = assign_likelihoods(w_.found_dots(), w_.grid_from_image, w_.grid);
    if (status == Status::ok &&
        !sample_cells(image, w_.smoothing.paper, filtered.lens, w_.grid_from_image, w_.grid))
        status = Status::not_certain;
    return status;
}

/// Finds the dots and the grid, and reads the bits. If the status is no_contrast or too_few_dots,
/// tries again with a lower minimum contrast, but only if the largest contrast in the image reaches
/// the lower minimum.
Status SecondAttempt::read_filtered(const Frame& frame) {
    DeviceOptions filtered = for_filtered(frame);
    const Status status = read_filtered_with(filtered, frame.image);
    const int pale =
        (frame.options.threshold.min_contrast + tuned::kPaleParts - 1) / tuned::kPaleParts;
    const bool may_be_pale = (status == Status::no_contrast || status == Status::too_few_dots) &&
                             w_.threshold.max_contrast >= pale;
    if (!may_be_pale) return status;
    const Fix seen = w_.fix;
    filtered.threshold.min_contrast = pale;
    if (read_filtered_with(filtered, frame.image) == Status::ok) return Status::ok;
    // Restores the result of the first try. The second try found no readable grid, so its
    // additional dots are probably noise.
    w_.fix = seen;
    w_.dot_count = 0;
    return status;
}

/// Finds the position from the bits, and verifies it against the bits of all dots.
Status SecondAttempt::read_position(const PlaceEvidence& evidence) {
    const auto& [kernels, options, known, earlier, line_scores, others, work] = evidence;
    const Grid& grid = w_.grid;
    Decoding& decoding = w_.decoding;
    // Chooses the window (paper, section II-B.5).
    decoding.window = choose_window(grid, kWindowSide);
    choose_region(w_);
    // Finds the orientation and the position (paper, sections II-B.6 and II-B.7).
    Status status = decode(options, grid, line_scores, decoding);
    if (status == Status::ok) {
        status = verify(kernels, grid, options.code, others, options.integrity, line_scores, work,
                        decoding, w_.fix);
    }
    if (status == Status::ok && !is_possible(options.code, decoding, known))
        status = Status::not_certain;
    const auto note_compared_bits = [&] {
        if (decoding.bits > 0)
            w_.measurement.compared = {middle_place(evidence.options.code, decoding).cell,
                                       decoding.bits, w_.fix.bit_errors};
    };
    note_compared_bits();
    if (status != Status::ok && known.any() &&
        read_on_sheets(kernels, options, grid, known, decoding, w_.fix)) {
        status = Status::ok;
        note_compared_bits();
    }
    return status == Status::ok ? status : refused(status, w_);
}

/// Measures the dots that the code predicts at the decoded position, and fits the map from image to
/// pattern. Returns false if the dots do not determine the map.
bool SecondAttempt::fit_pattern(const Frame& frame, const Nominal& nominal, PoseFit& fit) {
    const FixedLens& lens = frame.options.lens;
    PlaneFromImage& plane = w_.pattern_from_image;
    // Turns the plane upright (paper, section II-B.8).
    plane = upright_plane(w_.grid_from_image, w_.decoding.pattern_from_grid);
    w_.dot_count = measure_dots(frame.image, lens, plane, nominal, w_.grid, w_.dots);
    undistort(lens, centre_q8(frame.image), first(w_.dots, w_.dot_count));
    w_.seed_count = 0;  // seeds are indices of the previous dots
    return refine_pose({w_.found_dots(), w_.grid, nominal, &w_.smoothing.paper}, plane, fit);
}

/// Reads the bits again, using a grid fitted to the dots that the code predicts at a doubtful
/// position. If the position is correct, more bits are clear in the new grid.
Status SecondAttempt::resample(const Frame& frame, const PlaceEvidence& evidence) {
    const DeviceOptions& options = frame.options;
    PoseFit fit;
    if (!fit_pattern(frame, {w_.grid, options.code, w_.decoding}, fit)) return Status::not_certain;
    w_.grid_from_image = w_.pattern_from_image;
    w_.decoding.pattern_from_grid = {};
    if (!sample_cells(frame.image, w_.smoothing.paper, options.lens, w_.grid_from_image, w_.grid))
        return Status::not_certain;
    return read_position(evidence);
}

/// Measures the pose at the decoded position (paper, section II-B.8), and writes the pose and its
/// covariance into the fix. Returns no_grid if the dots do not determine the pose, and not_certain
/// if the pose does not explain the frame well (see `is_implausible`).
Status SecondAttempt::measure_pose(const Frame& frame) {
    const Nominal nominal(w_.grid, frame.options.code, w_.decoding);
    PoseFit fit;
    if (!fit_pattern(frame, nominal, fit)) return Status::no_grid;
    PlaneFromImage& plane = w_.pattern_from_image;
    const FixedVec reference = reference_q8(centre_q8(frame.image), frame.options);
    fit_uneven(frame.kernels, {w_.found_dots(), w_.grid, nominal}, reference, w_.measurement.dots,
               plane, fit);
    w_.fix.displacement_q16 = static_cast<std::int32_t>(fit.displacement * 65536.0F);
    write_pose(plane, reference, frame.options.code, w_.decoding.place, w_.fix);
    estimate_covariance(fit, plane, reference, w_.fix);
    return is_implausible(fit, w_.decoding.bits, w_.fix.bit_errors) ? Status::not_certain
                                                                    : Status::ok;
}

bool SecondAttempt::read(const Frame& frame, Resampling resampling) {
    const PlaceEvidence evidence = w_.evidence(frame);
    Status& status = w_.fix.status;
    if (!is_seen_) {
        status = read_filtered(frame);
        w_.fix.attempt = Attempt::second;
        seen_ = w_.fix;
        is_seen_ = true;
    }
    w_.fix = seen_;
    if (status != Status::ok) return false;
    w_.decoding = {};
    status = read_position(evidence);
    if (status == Status::not_certain && resampling == Resampling::if_doubtful) {
        status = resample(frame, evidence);
        is_seen_ = false;
    }
    if (status != Status::ok) return false;
    is_seen_ = false;  // `measure_pose` overwrites the dots
    status = measure_pose(frame);
    if (status != Status::ok) return false;
    weigh_other_codes(frame.kernels, w_.grid, frame.options.code, w_.decoding, w_.line_scores,
                      evidence.others);
    if (may_be_biased(w_.fix, w_.pattern_from_image, frame.image) &&
        measure_again(frame, evidence, w_.measurement, w_.fix))
        store_for_trace(w_.measurement, frame.options.show_stages, w_);
    return true;
}

}  // namespace dotpose::core

#include "core/attempts/second.hpp"

#include <algorithm>

#include "core/attempts/dot_reader.hpp"
#include "core/attempts/first.hpp"
#include "core/attempts/fitted_pose.hpp"
#include "core/attempts/steps.hpp"
#include "core/attempts/tracked.hpp"
#include "core/attempts/tuning.hpp"
#include "core/decode/likelihood.hpp"
#include "core/decode/position.hpp"
#include "core/decode/sample_cells.hpp"
#include "core/decode/window.hpp"
#include "core/detect/smooth.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "core/lattice/periodogram_search.hpp"
#include "core/lattice/refine_grid.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::second;

/// Returns the options with the thresholds of a filtered image.
Options for_filtered(Options options) {
    ThresholdOptions& threshold = options.threshold;
    threshold.min_contrast = threshold.min_contrast / 2 + 1;
    threshold.low_q8 = (tuned::kLow_3rds * threshold.low_q8 + 2) / 3;
    threshold.high_q8 = (tuned::kHigh_10ths * threshold.high_q8 + 9) / 10;
    return options;
}

/// Filters the image and detects its blobs.
void detect_filtered(const ImageView& image, const Options& filtered, Workspace& w) {
    begin_frame(image.width_px, image.height_px, w);
    begin_smoothing(image, w.smoothing);
    for (int v = 0; v < image.height_px; ++v)
        detect_row(next_smooth_row(image, w.smoothing), filtered, w);
}

/// Finds the grid that the dots lie on, also for tilted cameras and bent lenses; slower than
/// `find_grid`.
Status find_grid_thoroughly(const Options& options, Workspace& w) {
    const Vec centre_q8 = image_centre_q8(w.light);
    Status status = find_axes(centre_q8, kMaxSeeds, w);
    if (status != Status::ok) return status;
    const Lattice estimate = w.lattice;
    for (const int most_turn_deg : tuned::kMostTurns_deg) {
        w.lattice = estimate;
        search_periodogram(w.found_dots(), first(w.seeds, w.seed_count), centre_q8, most_turn_deg,
                           w.lattice);
        status =
            refine_grid(w.found_dots(), options.lattice, centre_q8, w.lattice, w.grid_from_image);
        if (status != Status::no_grid) break;
    }
    return status;
}

/// Samples the bits from the image through the grid. Returns false if it shows two overlapping
/// patterns.
bool shows_one_pattern(const ImageView& image, const Options& options, Workspace& w) {
    return sample_cells(image, w.smoothing.paper, options.lens, w.grid_from_image, w.grid);
}

/// Decodes by the decoder of the options.
Status decode(const Options& options, Workspace& w) {
    if (options.decoder == Decoder::window) {
        return decode_window(w.grid, options.profile, w.line_scores, w.decoding);
    }
    return decode_all(w.grid, options.profile, w.line_scores, w.decoding);
}

/// Samples the bits again, given one axis of the position that is beyond doubt: each bit of the
/// other axis has only two possible places then.
Status resample_given_axis(Axis known, const ImageView& image, const Options& options,
                           Workspace& w) {
    const Place place = w.decoding.place;
    resample_cells_given_axis(known, options.profile, w.decoding, image, w.smoothing.paper,
                              options.lens, w.grid_from_image, w.grid);
    const Status status = read_position(options, w);
    // The bits were sampled given the known axis, so the new position must agree with it.
    const bool is_as_known = w.decoding.pattern_from_grid.quarters == 0 &&
                             share_line(known, options.profile, place, w.decoding.place);
    return is_as_known ? status : Status::not_certain;
}

/// Reads the bits again through a grid fitted to the dots of the doubtful position: if that is
/// right, they are clearer. The code must confirm them as any others.
Status resample(const ImageView& image, const Options& options, bool may_presume, Workspace& w) {
    const auto known = sure_axis(w.decoding, options.integrity);
    PoseFit fit;
    if (!fit_pattern(options, &image, w, fit)) return Status::not_certain;
    w.grid_from_image = w.pattern_from_image;
    w.decoding.pattern_from_grid = {};
    w.decoding.p_wrong_log2_q8 = {};  // They belonged to the bits before.
    if (known && may_presume) return resample_given_axis(*known, image, options, w);
    return shows_one_pattern(image, options, w) ? read_position(options, w) : Status::not_certain;
}

/// Measures the dots of the fix as the first attempt does, whose centres are not biased, if they
/// fall on the pixels alike.
void take_bias(const ImageView& image, const Options& options, Workspace& w) {
    if (!searches_outwards(options, w)) return;
    const float variance_px2 =
        w.fix.residual_px * w.fix.residual_px / static_cast<float>(w.fix.dots_used);
    if (may_be_biased(float_plane(w.pattern_from_image), variance_px2,
                      std::max(image.width_px, image.height_px))) {
        measure_again(kernels(), image, options, w);
    }
}

/// Finds dots and grid in the filtered image, and reads the bits.
Status see_with(const Options& filtered, const ImageView& image, Workspace& w) {
    detect_filtered(image, filtered, w);
    Status status = find_dots(filtered, w);                                // II-B.1
    if (status == Status::ok) status = find_grid_thoroughly(filtered, w);  // II-B.2-3
    if (status == Status::ok) {
        status = assign_likelihoods(w.found_dots(), w.grid_from_image, w.grid);  // II-B.4
    }
    if (status != Status::ok) return status;
    return shows_one_pattern(image, filtered, w) ? Status::ok : Status::not_certain;
}

}  // namespace

Status see_filtered(const ImageView& image, const Options& options, Workspace& w) {
    Options filtered = for_filtered(options);
    const Status status = see_with(filtered, image, w);
    const int pale = (options.threshold.min_contrast + tuned::kPaleParts - 1) / tuned::kPaleParts;
    const bool may_be_pale = (status == Status::no_contrast || status == Status::too_few_dots) &&
                             w.light.greatest_contrast >= pale;
    if (!may_be_pale) return status;
    const Fix seen = w.fix;
    filtered.threshold.min_contrast = pale;
    if (see_with(filtered, image, w) == Status::ok) return Status::ok;
    // The second look found no pattern: its dots were noise, so the result of the first look
    // stands.
    w.fix = seen;
    w.dot_count = 0;
    return status;
}

Status read_position(const Options& options, Workspace& w) {
    w.decoding.window = choose_window(w.grid, kWindowSide);  // II-B.5
    choose_region(w);
    Status status = decode(options, w);  // II-B.6-7
    if (status == Status::ok) {
        status = verify_among_codes(w.grid, options.profile, wanted_codes(w), w.decoding,
                                    options.integrity, w.line_scores, w.fix);
    }
    return status == Status::ok ? status : refused(status, w);
}

Status resample_until_certain(const ImageView& image, const Options& options, Workspace& w) {
    for (const bool may_presume : tuned::kResamplesPresume) {
        if (resample(image, options, may_presume, w) == Status::ok) return Status::ok;
    }
    return Status::not_certain;
}

Status measure_and_weigh(const ImageView& image, const Options& options, Workspace& w) {
    const Status status = measure_pose(options, &image, w);  // II-B.8
    w.fix.attempt = Attempt::second;
    if (status == Status::ok) {
        weigh_other_codes(kernels(), w.grid, options.profile, w.decoding, w.line_scores,
                          wanted_codes(w));
        take_bias(image, options, w);
    }
    return status;
}

Fix make_second_attempt(const ImageView& image, const Options& options, Workspace& w) {
    Status status = see_filtered(image, options, w);
    if (status == Status::ok) {
        status = read_position(options, w);
        if (status == Status::not_certain) status = resample_until_certain(image, options, w);
        if (status == Status::ok) status = measure_and_weigh(image, options, w);
    }
    w.fix.status = status;
    w.fix.attempt = Attempt::second;
    return w.fix;
}

}  // namespace dotpose::core

// The pipeline of the paper's Fig. 1: image -> dots -> grid -> bits -> position -> pose.
#include "dotpose/locate.hpp"

#include <cmath>

#include "core/decode/likelihood.hpp"
#include "core/decode/look.hpp"
#include "core/decode/nominal.hpp"
#include "core/decode/orientation.hpp"
#include "core/decode/position.hpp"
#include "core/decode/verify.hpp"
#include "core/decode/window.hpp"
#include "core/detect/blobs.hpp"
#include "core/detect/light.hpp"
#include "core/detect/smooth.hpp"
#include "core/detect/undistort.hpp"
#include "core/lattice/axes.hpp"
#include "core/lattice/climb.hpp"
#include "core/lattice/grow.hpp"
#include "core/lattice/neighbours.hpp"
#include "core/lattice/origin.hpp"
#include "core/lattice/refine.hpp"
#include "core/pose/affine_pose.hpp"
#include "core/pose/covariance.hpp"
#include "core/pose/measure.hpp"
#include "core/pose/refine.hpp"
#include "core/pose/subgrid.hpp"

namespace dotpose {
namespace {

using core::DotList;

DotList dot_list(Workspace& w) {
    return {w.dots, w.dot_count, w.dots_kept_within_px};
}

template <typename T, std::size_t Extent>
std::span<T> first(std::span<T, Extent> all, int count) {
    return all.first(static_cast<std::size_t>(count));
}

Vec image_centre_q8(const Light& light) {
    return {(light.width_px - 1) * 128, (light.height_px - 1) * 128};
}

std::span<const std::uint16_t> found_seeds(const Workspace& w) {
    return first(w.seeds, w.seed_count);
}

/// Bands of rows that are ready -> blobs.
// By itself, as most rows complete none.
[[gnu::noinline]] void threshold_bands(int ready, const Options& options, Workspace& w) {
    const int newest = (w.light.rows_taken - 1) >> w.light.band_shift;
    const bool is_last = w.light.rows_taken == w.light.height_px;
    for (int band = newest - ready + (is_last ? 1 : 0); ready > 0; --ready, ++band) {
        core::measure_levels(band, options.threshold, w.light);
        for (int v = core::band_begin(w.light, band); v < core::band_end(w.light, band); ++v) {
            core::grow_blobs(v, w.light, w.open, dot_list(w));  // II-B.1
        }
    }
}

/// Blobs -> dots where a lens without distortion would see them.
Status find_dots(const Options& options, Workspace& w) {
    core::sift_dots(options.blobs, dot_list(w));
    w.fix.dots_seen = w.dot_count;
    if (!w.light.has_contrast) return Status::no_contrast;
    if (w.dot_count < options.lattice.min_dots) return Status::too_few_dots;
    core::undistort(options.lens, image_centre_q8(w.light), first(w.dots, w.dot_count));  // eq. 1-2
    return Status::ok;
}

/// Dots that give the first grid of a first attempt.
constexpr int kFirstSeeds = 64;

/// Dots -> their connections -> directions and spacings of the grid.
Status find_axes(int most_seeds, Workspace& w) {
    const auto dots = w.found_dots();
    const int room = std::min(most_seeds, static_cast<int>(w.seeds.size()));
    w.seed_count = core::choose_seeds(dots, image_centre_q8(w.light), first(w.seeds, room));
    const auto seeds = found_seeds(w);
    core::find_neighbours(dots, seeds, w.neighbours);  // II-B.2, Fig. 3
    w.edge_count = core::connect_symmetric(dots, seeds, w.neighbours, w.edges);
    return core::estimate_axes(first(w.edges, w.edge_count), w.lattice);  // Fig. 4-5
}

/// Dots -> the grid they lie on.
Status find_grid(const Options& options, Workspace& w) {
    const Status status = find_axes(kFirstSeeds, w);
    if (status != Status::ok) return status;
    const Vec centre_q8 = image_centre_q8(w.light);
    core::find_origin(w.found_dots(), found_seeds(w), centre_q8, w.lattice);
    return core::grow_grid(w.found_dots(), options.lattice, centre_q8, w.lattice,
                           w.grid_from_image);  // II-B.3
}

/// The same with more patience, and for tilted cameras and lenses that bend.
Status find_grid_thoroughly(const Options& options, Workspace& w) {
    Status status = find_axes(kMaxSeeds, w);
    if (status != Status::ok) return status;
    const Vec centre_q8 = image_centre_q8(w.light);
    const Lattice estimate = w.lattice;
    // Between graphics, the connections of what is left of the dots may point anywhere.
    for (const int most_turn_deg : {12, 45}) {
        w.lattice = estimate;
        core::climb_periodogram(w.found_dots(), found_seeds(w), centre_q8, most_turn_deg,
                                w.lattice);
        status = core::refine_grid(w.found_dots(), options.lattice, centre_q8, w.lattice,
                                   w.grid_from_image);
        if (status != Status::no_grid) break;
    }
    return status;
}

/// Dots and grid -> bits.
Status read_bits(decltype(core::assign_likelihoods) assign, Workspace& w) {
    return assign(w.found_dots(), w.grid_from_image, w.grid);  // II-B.4, eq. 7-9
}

using Decode = decltype(core::decode_all);

/// The decoder asked for, or else `decode`.
Decode* decoder(const Options& options, Decode* decode) {
    return options.decoder == Decoder::window ? core::decode_window : decode;
}

/// The reason for which bits are refused, or a better one.
Status refused(Status reason, const Workspace& w) {
    const Decoding& decoding = w.decoding;
    return core::is_mirrored(w.grid, decoding.region, decoding.agreement) ? Status::mirrored
                                                                          : reason;
}

/// Devices have no room for a second attempt, and no time for what is only shown.
bool is_of_device(const Workspace& w) {
    return w.smoothing.row.empty();
}

/// Bits -> position in the code.
Status read_position(const Options& options, Decode* decode, Workspace& w) {
    Decoding& decoding = w.decoding;
    if (!is_of_device(w)) decoding.window = core::choose_window(w.grid, kWindowSide);  // II-B.5
    decoding.region = core::choose_window(w.grid, static_cast<int>(w.line_scores.size() / 2));
    const Status status = decode(w.grid, options.profile, w.line_scores, decoding);  // II-B.6-7
    return status == Status::ok ? status : refused(status, w);
}

/// Whether all dots in view agree with the position.
Status verify_position(const Options& options, decltype(core::verify) verify, Workspace& w) {
    const Status status =
        verify(w.grid, options.profile, w.decoding, options.integrity, w.line_scores, w.fix);
    return status == Status::ok ? status : refused(status, w);
}

/// Blobs -> position in the code.
Status find_position(const Options& options, Decode* decode, decltype(core::verify) verify,
                     Workspace& w) {
    Status status = find_dots(options, w);
    if (status == Status::ok) status = find_grid(options, w);
    if (status == Status::ok) status = read_bits(core::assign_affine_likelihoods, w);
    if (status == Status::ok) status = read_position(options, decode, w);
    if (status == Status::ok) status = verify_position(options, verify, w);
    return status;
}

/// The point whose pose is wanted.
Vec reference_q8(const Options& options, const Workspace& w) {
    const Vec centre_q8 = image_centre_q8(w.light);
    return {centre_q8.x + options.reference_dx_q8, centre_q8.y + options.reference_dy_q8};
}

/// Position -> pose, in integers, as a device without floating point does it.
Status measure_affine_pose(const Options& options, Workspace& w) {
    const core::Nominal nominal(w.grid, options.profile, w.decoding);
    w.pattern_from_image =
        core::upright_plane(w.grid_from_image, w.decoding.pattern_from_grid);  // II-B.8
    const core::Observations observations(w.found_dots(), w.grid, nominal);
    w.fix.dots_used =
        core::fit_affine_pose(observations, w.pattern_from_image, w.fix.displacement_q16);
    if (w.fix.dots_used == 0) return Status::no_grid;
    core::write_affine_pose(w.pattern_from_image, reference_q8(options, w), options.profile,
                            w.decoding.place, w.fix);
    w.fix.attempt = Attempt::device;
    return Status::ok;
}

/// Position -> map from the image to the pattern. With an `image`, dots are measured in it once
/// more. Returns false when the dots do not determine it.
bool fit_pattern(const Options& options, const ImageView* image, Workspace& w, core::PoseFit& fit) {
    const core::Nominal nominal(w.grid, options.profile, w.decoding);
    w.pattern_from_image =
        core::upright_plane(w.grid_from_image, w.decoding.pattern_from_grid);  // II-B.8
    if (image != nullptr) {
        w.dot_count =
            core::measure_dots(*image, options.lens, w.pattern_from_image, nominal, w.grid, w.dots);
        core::undistort(options.lens, image_centre_q8(w.light), first(w.dots, w.dot_count));
        w.seed_count = 0;  // They were of the dots before.
    }
    const core::Observations observations(w.found_dots(), w.grid, nominal,
                                          image != nullptr ? &w.smoothing.paper : nullptr);
    return core::refine_pose(observations, w.pattern_from_image, fit);
}

float spacing_px(const Fix& fix) {
    return static_cast<float>(fix.spacing_px_q16) / 65536.0F;
}

/// Whether the position explains badly what is seen: dots that are not where it has them, bits that
/// are others. Two patterns that lie on one another, nearly in line, can pass for a third one,
/// which has the columns of the one and the rows of the other: a quarter of its cells show no dot
/// at its place, half of the dots are beside theirs, and so the typical displacement comes out too
/// small. docs/integrity.md has the numbers.
bool is_far_fetched(const core::PoseFit& fit, const Decoding& decoding, const Fix& fix) {
    constexpr float kMost = 0.57F;
    if (fit.displacement <= 0) return true;
    const float scatter = std::sqrt(fit.variance) / fit.displacement;
    const float contradicted =
        static_cast<float>(fix.bit_errors) / static_cast<float>(decoding.bits);
    return scatter + contradicted > kMost;
}

/// Position -> pose.
Status measure_pose(const Options& options, const ImageView* image, Workspace& w) {
    core::PoseFit fit;
    if (!fit_pattern(options, image, w, fit)) return Status::no_grid;
    const Vec reference = reference_q8(options, w);
    w.fix.displacement_q16 = static_cast<std::int32_t>(fit.displacement * 65536.0F);
    core::write_pose(w.pattern_from_image, reference, options.profile, w.decoding.place, w.fix);
    core::estimate_covariance(fit, w.pattern_from_image, reference, w.fix);
    return is_far_fetched(fit, w.decoding, w.fix) ? Status::not_certain : Status::ok;
}

/// Dots this far from where the pose has them are worth a second attempt: in px, for those that
/// noise has moved, and in spacings, for those that were printed badly.
constexpr float kRough_px = 0.30F;
constexpr float kRough = 0.027F;

bool is_rough(const Fix& fix) {
    return fix.residual_px >= std::max(kRough_px, kRough * spacing_px(fix));
}

constexpr bool is_within(int value, int low, int high) {
    return value >= low && value <= high;
}

/// Whether the options are such that no stage can overflow.
bool are_valid(const Options& options) {
    constexpr int kFarthestReference_q8 = 16384 * 256;
    constexpr int kFarthestLens_q8 = 1024 * 256;
    return is_within(options.threshold.extent_q8, 1, 256) &&
           is_within(options.threshold.core_q8, 1, 256) &&
           is_within(options.threshold.min_contrast, 1, 255) &&
           is_within(options.blobs.min_mass_q8, 0, 256) &&
           is_within(options.blobs.max_area_ratio, 1, 1024) &&
           is_within(options.lattice.max_offset_q16, 0, 32768) &&
           is_within(options.integrity.max_bit_error_q8, 0, 256) &&
           is_within(options.reference_dx_q8, -kFarthestReference_q8, kFarthestReference_q8) &&
           is_within(options.reference_dy_q8, -kFarthestReference_q8, kFarthestReference_q8) &&
           is_within(options.lens.centre_dx_q8, -kFarthestLens_q8, kFarthestLens_q8) &&
           is_within(options.lens.centre_dy_q8, -kFarthestLens_q8, kFarthestLens_q8);
}

/// Grid -> bits, from the image itself. False if it shows two patterns, one on the other.
bool shows_one_pattern(const ImageView& image, const Options& options, Workspace& w) {
    return core::look_at_cells(image, w.smoothing.paper, options.lens, w.grid_from_image, w.grid);
}

/// Bits -> position, and whether it is certain.
Status read_thoroughly(const Options& options, Workspace& w) {
    const Status status = read_position(options, decoder(options, core::decode_all), w);
    return status == Status::ok ? verify_position(options, core::verify, w) : status;
}

/// One axis of the position is beyond doubt: each bit of the other has only two places left.
Status look_knowing(core::Axis known, const ImageView& image, const Options& options,
                    Workspace& w) {
    const Place place = w.decoding.place;
    core::look_at_cells_knowing(known, options.profile, w.decoding, image, w.smoothing.paper,
                                options.lens, w.grid_from_image, w.grid);
    const Status status = read_thoroughly(options, w);
    // What was read presumes the axis that was known.
    const bool is_as_known = w.decoding.pattern_from_grid.quarters == 0 &&
                             core::share_line(known, options.profile, place, w.decoding.place);
    return is_as_known ? status : Status::not_certain;
}

/// Where the position in doubt is right, a grid fitted to all dots that it has there shows their
/// bits more clearly. The code has to confirm them like any others.
Status look_again(const ImageView& image, const Options& options, bool may_presume, Workspace& w) {
    const auto known = core::sure_axis(w.decoding, options.integrity);
    core::PoseFit fit;
    if (!fit_pattern(options, &image, w, fit)) return Status::not_certain;
    w.grid_from_image = w.pattern_from_image;
    w.decoding.pattern_from_grid = {};
    w.decoding.p_wrong_log2_q8 = {};  // Of the bits before.
    if (known && may_presume) return look_knowing(*known, image, options, w);
    return shows_one_pattern(image, options, w) ? read_thoroughly(options, w) : Status::not_certain;
}

/// Looks through one grid after the other. What presumed an axis is no ground to presume the other:
/// every second look presumes none.
Status look_until_certain(const ImageView& image, const Options& options, Workspace& w) {
    for (const bool may_presume : {true, false, true}) {
        if (look_again(image, options, may_presume, w) == Status::ok) return Status::ok;
    }
    return Status::not_certain;
}

/// The second attempt, on the image filtered; bits are read from it rather than from blobs.
Fix locate_filtered(const ImageView& image, const Options& options, Workspace& w) {
    Options filtered = options;
    // Filtered, noise is a third of what it was, and dots are paler and wider.
    ThresholdOptions& threshold = filtered.threshold;
    threshold.min_contrast = threshold.min_contrast / 2 + 1;
    threshold.extent_q8 = (2 * threshold.extent_q8 + 2) / 3;
    threshold.core_q8 = (9 * threshold.core_q8 + 9) / 10;
    Status status = begin(image.width_px, image.height_px, filtered, w);
    core::begin_smoothing(image, w.smoothing);
    for (int v = 0; v < image.height_px; ++v)
        push_row(core::next_smooth_row(image, w.smoothing), filtered, w);
    if (status == Status::ok) status = find_dots(filtered, w);
    if (status == Status::ok) status = find_grid_thoroughly(filtered, w);
    if (status == Status::ok) status = read_bits(core::assign_likelihoods, w);
    if (status == Status::ok && !shows_one_pattern(image, filtered, w)) {
        w.fix.status = Status::not_certain;
        return w.fix;
    }
    if (status == Status::ok) status = read_thoroughly(filtered, w);
    if (status == Status::not_certain) status = look_until_certain(image, filtered, w);
    if (status == Status::ok) status = measure_pose(filtered, &image, w);
    w.fix.status = status;
    w.fix.attempt = Attempt::second;
    return w.fix;
}

}  // namespace

Fix locate(const ImageView& image, const Options& options, Workspace& workspace) {
    const Status status = begin(image.width_px, image.height_px, options, workspace);
    if (status == Status::ok && image.pixels == nullptr) {
        workspace.fix.status = Status::bad_argument;
        return workspace.fix;
    }
    if (status != Status::ok) return workspace.fix;
    for (int v = 0; v < image.height_px; ++v)
        push_row(image.row(v), options, workspace);
    if (options.effort == Effort::device) return finish_device(options, workspace);
    const Fix fix = finish(options, workspace);
    const bool is_good = fix.status == Status::ok && !is_rough(fix);
    if (is_good || options.effort == Effort::once || is_of_device(workspace)) return fix;
    const Fix second = locate_filtered(image, options, workspace);
    if (second.status == Status::ok || fix.status != Status::ok) return second;
    // The workspace must show what is returned.
    Options once = options;
    once.effort = Effort::once;
    return locate(image, once, workspace);
}

Fix locate(const ImageView& image, const Options& options, const Prediction&,
           Workspace& workspace) {
    return locate(image, options, workspace);
}

Status begin(int width_px, int height_px, const Options& options, const Prediction&,
             Workspace& workspace) {
    return begin(width_px, height_px, options, workspace);
}

Status begin(int width_px, int height_px, const Options& options, Workspace& w) {
    w.fix = Fix{};
    w.dot_count = w.seed_count = w.edge_count = 0;
    w.lattice = {};
    w.decoding = {};
    w.grid.columns = w.grid.rows = 0;
    if (!are_valid(options)) return w.fix.status = Status::bad_argument;
    if (width_px < kMinFrameSide_px || height_px < kMinFrameSide_px) {
        return w.fix.status = Status::image_too_small;
    }
    if (width_px > w.max_width_px || height_px > kMaxFrameSide_px) {
        return w.fix.status = Status::image_too_large;
    }
    core::begin_light(width_px, height_px, w.light);
    core::begin_blobs(w.light, w.open, dot_list(w));
    return Status::ok;
}

void push_row(const std::uint8_t* pixels, const Options& options, Workspace& w) {
    const int ready = core::take_row(pixels, w.light);
    if (ready > 0) threshold_bands(ready, options, w);
}

Fix finish(const Options& options, Workspace& w) {
    Status status = find_position(options, decoder(options, core::decode_briefly), core::verify, w);
    if (status == Status::ok) status = measure_pose(options, nullptr, w);
    w.fix.status = status;
    return w.fix;
}

Fix finish_device(const Options& options, Workspace& w) {
    Status status = find_position(options, core::decode_briefly, core::verify_quickly, w);
    if (status == Status::ok) status = measure_affine_pose(options, w);
    w.fix.status = status;
    return w.fix;
}

}  // namespace dotpose

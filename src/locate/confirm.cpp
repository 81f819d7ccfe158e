#include "locate/confirm.hpp"

#include <algorithm>
#include <cmath>

#include "core/decode/bit_lines.hpp"
#include "core/decode/window.hpp"
#include "core/integrity/certainty.hpp"
#include "core/integrity/coded_block.hpp"
#include "core/integrity/codes_in_view.hpp"
#include "core/integrity/known_places.hpp"
#include "core/pose/covariance.hpp"
#include "core/pose/float_fit.hpp"
#include "core/pose/subgrid.hpp"
#include "core/pose/tuning.hpp"
#include "core/pose/turn_fit.hpp"
#include "core/pose/uneven.hpp"
#include "core/steps.hpp"
#include "locate/dot_reader.hpp"
#include "locate/fitted_pose.hpp"
#include "locate/on_sheets.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::confirm;

float half_side_px(const ImageView& image) {
    return std::max(static_cast<float>(image.width_px), static_cast<float>(image.height_px)) / 2;
}

/// Returns true if all of these conditions hold:
/// - At least `min_dots` dots were read, and at least half of the seen dots were read.
/// - Dots were seen in at least a quarter of the listed cells, or the view is partial.
/// - On each axis, at most max_bit_error_q8 / 256 of the bits contradict the code.
bool is_plausible(const BitsRead& bits, const MeasuredDots& dots, const DeviceOptions& options,
                  int min_dots, bool is_partial_view) {
    const bool is_full = 4 * bits.seen >= dots.count || is_partial_view;
    const auto exceeds_error_rate = [&](int wrong) {
        return 256 * wrong > bits.read * options.integrity.max_bit_error_q8;
    };
    return bits.read >= min_dots && is_full && 2 * bits.read >= bits.seen &&
           !exceeds_error_rate(bits.wrong_x) && !exceeds_error_rate(bits.wrong_y);
}

/// Returns true if the bits need no second reading. At least kClear_percent of the dots seen must
/// be clear. If n dots were read, at most max(kMaxWrong, n / kDotsPerWrong) bits may be wrong.
bool is_clean(const BitsRead& bits) {
    return 100 * bits.read >= tuned::kClear_percent * bits.seen &&
           bits.wrong_x + bits.wrong_y <=
               std::max(tuned::kMaxWrong, bits.read / tuned::kDotsPerWrong);
}

std::array<Confidence, 2> confidences_in(const BitsRead& bits) {
    return {Confidence::of_hard_bits(bits.read, bits.wrong_x),
            Confidence::of_hard_bits(bits.read, bits.wrong_y)};
}

/// Returns true if `block` makes the place of the hypothesis certain. `block` contains only the
/// bits of the current frame.
bool is_certain_alone(const Kernels& kernels, const DeviceOptions& options,
                      const Hypothesis& hypothesis, const CellsInView& view, const BitBlock& block,
                      const BitsRead& bits, DesktopWorkspace& w) {
    const auto confidences = confidences_in(bits);
    OtherCodes* others = wanted_codes(w);
    if (w.known.are_all() && !shows_sheet(w.known, options.code, hypothesis.place, block))
        return false;
    const CodedBlock coded(options.code, hypothesis.place, view, block);
    if (passes_hard_bit_test(
            kernels, {coded.axis(Axis::x, confidences[0]), coded.axis(Axis::y, confidences[1])},
            options.code, options.integrity, w.fix, others)) {
        return true;
    }
    if (w.known.any() &&
        is_certain_on_sheets(kernels, options, hypothesis.place, block, w.known, w.fix)) {
        return true;
    }
    const Evidence evidence =
        evidence_of(kernels, options.code, hypothesis.place, block, confidences, w.line_scores);
    return is_certain(kernels, evidence, options.code, options.integrity, w.fix, others);
}

/// Returns true if `block` and the bits of earlier frames together make the place certain.
/// `grid_from_image` is relative to the image centre.
bool is_certain_together(const Kernels& kernels, const DeviceOptions& options, const Place& place,
                         const FloatPlane& grid_from_image, const BitBlock& block,
                         DesktopWorkspace& w) {
    // There are two possible errors: a wrong match of the grids and a wrong place. Each of them may
    // have half of the permitted probability.
    DeviceOptions half = options;
    --half.integrity.max_p_wrong_log2;
    const auto joined = w.earlier.join(block, grid_from_image);
    if (!joined) return false;
    const bool is_on_sheet =
        w.known.any() && is_certain_on_sheets(kernels, half, place, joined->block, w.known, w.fix);
    if (!is_on_sheet) {
        if (w.known.are_all()) return false;
        const Evidence evidence =
            evidence_of(kernels, options.code, place, joined->block,
                        compared_with_code(options.code, place, joined->block), w.line_scores);
        if (!is_certain(kernels, evidence, options.code, half.integrity, w.fix, wanted_codes(w)))
            return false;
    }
    w.fix.p_wrong_log2 = 1 + std::max(w.fix.p_wrong_log2, joined->p_mismatch_log2);
    w.fix.frames = joined->frames;
    return true;
}

/// Returns ok if the bits make the place of the hypothesis certain, and uncertain otherwise. Also
/// uses the bits of earlier frames if frames are read together.
Confirmation confirm_place(const Kernels& kernels, const DeviceOptions& options,
                           const Hypothesis& hypothesis, const CellsInView& view,
                           const BitBlock& block, const BitsRead& bits, DesktopWorkspace& w) {
    w.decoding.bits = 2 * bits.read;
    bool is_certain = is_certain_alone(kernels, options, hypothesis, view, block, bits, w);
    if (w.earlier.is_in_series()) {
        const FloatVec from = hypothesis.from_centre;
        const FloatPlane grid = recentred(hypothesis.pattern_from_image, {-from.x, -from.y});
        is_certain =
            is_certain || (w.earlier.is_joining &&
                           is_certain_together(kernels, options, hypothesis.place, grid, block, w));
        w.earlier.note(block, grid, is_certain);
    }
    return is_certain ? Confirmation::ok : Confirmation::uncertain;
}

/// Returns true if the image shows fewer cells than any certain position needs. With so few cells,
/// random bits would agree with some position. Overwrites the list of dots.
bool shows_too_few_cells(const Kernels& kernels, const DeviceOptions& options, CellsInView view,
                         MeasuredDots& dots) {
    view.margin_px = 0;
    kernels.list_cells(view, dots);
    // Adds a margin of 1/kTolerance, because a second attempt may find a plane with a few more
    // cells in view.
    constexpr int kTolerance = 16;
    const int cells = dots.count + dots.count / kTolerance + 1;
    const Confidence axis = Confidence::of_hard_bits(cells, 0);
    return chance_log2(axis, odds_per_bit_q8(Confidence::of_hard_bits(2 * cells, 0))) >
           options.integrity.max_p_wrong_log2;
}

/// Writes the dots and their bits into the workspace, for the trace.
void show(const Hypothesis& hypothesis, DesktopWorkspace& w) {
    const MeasuredDots& dots = w.measured;
    const auto side = std::min(w.grid.side, kMaxGridSide);
    FixedVec first{INT32_MAX, INT32_MAX};
    FixedVec last{INT32_MIN, INT32_MIN};
    w.dot_count = 0;
    const auto cell_of = [&](std::size_t k) {
        return FixedVec{static_cast<std::int32_t>(dots.column[k]),
                        static_cast<std::int32_t>(dots.row[k])};
    };
    const auto is_near = [&](FixedVec cell) { return is_within(cell, (side - 1) / 2); };
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        const FixedVec cell = cell_of(k);
        if (!is_near(cell) || dots.x[k] >= kNoDot_px) continue;
        first = {std::min(first.x, cell.x), std::min(first.y, cell.y)};
        last = {std::max(last.x, cell.x), std::max(last.y, cell.y)};
    }
    Grid& grid = w.grid;
    grid.i0 = first.x;
    grid.j0 = first.y;
    grid.columns = last.x - first.x + 1;
    grid.rows = last.y - first.y + 1;
    std::fill_n(grid.storage.begin(), grid.columns * grid.rows, GridCell{});
    const FixedVec centre_q8 = w.pattern_from_image.centre_q8;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        const FixedVec cell = cell_of(k);
        if (!is_near(cell) || dots.x[k] >= kNoDot_px ||
            w.dot_count >= static_cast<int>(w.dots.size()))
            continue;
        DetectedDot& dot = w.dots[static_cast<std::size_t>(w.dot_count)];
        dot.centre_q8 =
            centre_q8 + FixedVec{static_cast<std::int32_t>(std::floor(dots.x[k] * 256 + 0.5F)),
                                 static_cast<std::int32_t>(std::floor(dots.y[k] * 256 + 0.5F))};
        dot.mass = static_cast<std::uint16_t>(std::min<std::int32_t>(dots.mass[k], 65535));
        dot.area_px = 0;
        const FloatVec at = plane_point(hypothesis.pattern_from_image, {dots.x[k], dots.y[k]});
        const float off_x = at.x - dots.column[k];
        const float off_y = at.y - dots.row[k];
        const auto weight = [&](float clear) {
            return static_cast<std::int8_t>(
                std::clamp(127 * clear / hypothesis.displacement, -127.0F, 127.0F));
        };
        GridCell& here = grid.at(cell.x, cell.y);
        here = {weight(off_y - off_x), weight(off_y + off_x),
                static_cast<std::uint16_t>(w.dot_count)};
        ++w.dot_count;
    }
    Decoding& decoding = w.decoding;
    decoding.region = {grid.i0, grid.j0, grid.columns, grid.rows};
    decoding.window = choose_window(grid, kWindowSide);
    w.grid_from_image = w.pattern_from_image;
}

/// Fits the plane and the displacement to the measured dots. Returns false if the dots do not
/// determine the plane.
bool fit_to_dots(const Kernels& kernels, const MeasuredDots& dots, const BitsRead& bits,
                 const ImageView& image, Hypothesis& hypothesis, PoseFit& fit) {
    if (bits.right == 0) return false;
    const auto right = static_cast<float>(bits.right);
    hypothesis.displacement = bits.projected / right;
    const float limit = tuned::kOutlier * bits.squares / right + 1e-6F;
    return fit_plane(kernels, dots, static_cast<int>(half_side_px(image)) + 1, limit,
                     hypothesis.displacement, hypothesis.pattern_from_image, fit);
}

/// Corrects pixel bias and neighbour bias if they matter, and then fits the plane again. Returns
/// the variance of the mean centre due to the remaining pixel bias, along u and v, in px^2. Returns
/// 0 if nothing was corrected, or if the new fit failed.
FloatVec fit_without_bias(const Kernels& kernels, const DotReader& reader, const CellsInView& view,
                          const ImageView& image, Hypothesis& hypothesis, PoseFit& fit) {
    FloatVec remaining_px2;
    const bool has_pixel_bias = reader.correct_pixel_bias(view, hypothesis, fit, remaining_px2);
    if (!reader.correct_neighbour_bias(hypothesis, fit) && !has_pixel_bias) return {};
    FloatPlane better = hypothesis.pattern_from_image;
    PoseFit better_fit;
    // The fit fails if the correction has dropped too many dots at the border.
    if (!fit_plane(kernels, reader.dots(), static_cast<int>(half_side_px(image)) + 1,
                   tuning::fit::kOutlier * fit.variance, fit.displacement, better, better_fit)) {
        return {};
    }
    hypothesis.pattern_from_image = better;
    hypothesis.displacement = fit.displacement;
    fit = better_fit;
    return remaining_px2;
}

/// Adds the variance of an image point to the pose covariance. Converts the variance from px^2,
/// along u and v, to spacings^2.
void add_variance(FloatVec px2, const FloatPlane& plane, PoseFit& fit) {
    const std::array<float, 2> by_u{plane.du_x, plane.du_y};
    const std::array<float, 2> by_v{plane.dv_x, plane.dv_y};
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 0; j < 2; ++j)
            fit.uneven[i][j] += px2.x * by_u[i] * by_u[j] + px2.y * by_v[i] * by_v[j];
    }
}

void add_covariance(const std::array<std::array<float, 3>, 3>& covariance, PoseFit& fit) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            fit.uneven[i][j] += covariance[i][j];
    }
}

void write_fix(const ImageView& image, const DeviceOptions& options, const Hypothesis& hypothesis,
               const BitsRead& bits, const PoseFit& fit, DesktopWorkspace& w) {
    w.fix.dots_seen = bits.seen;
    w.fix.bit_errors = bits.wrong_x + bits.wrong_y;
    w.fix.displacement_q16 = static_cast<std::int32_t>(fit.displacement * 65536);
    const FixedVec centre_q8{(image.width_px - 1) * 128, (image.height_px - 1) * 128};
    const FloatVec from = hypothesis.from_centre;
    const FixedVec from_q8{static_cast<std::int32_t>(from.x * 256),
                           static_cast<std::int32_t>(from.y * 256)};
    w.pattern_from_image = fixed_plane(hypothesis.pattern_from_image, centre_q8 + from_q8);
    w.decoding.place = hypothesis.place;
    w.decoding.pattern_from_grid = {};
    const FixedVec reference = reference_q8(centre_q8, options);
    write_pose(w.pattern_from_image, reference, options.code, hypothesis.place, w.fix);
    estimate_covariance(fit, w.pattern_from_image, reference, w.fix);
    if (!(from_q8 == FixedVec{})) {
        // Moves the centre of the plane to the image centre, because predictions need such a plane.
        w.fix.pattern_from_image =
            fixed_plane(recentred(hypothesis.pattern_from_image, {-from.x, -from.y}), centre_q8);
    }
    w.fix.status = Status::ok;
}

/// Returns true if the fit moved a corner of the measured part by more than kFar spacings along an
/// axis. The measured part is the part of the image within `reach_px` of the image centre. Small
/// centroid windows do not measure such large offsets accurately.
bool is_far_from(const FloatPlane& before, const FloatPlane& now, const ImageView& image,
                 float reach_px) {
    const FloatVec centre = centre_px(image);
    const FloatVec half{std::min(centre.x, reach_px), std::min(centre.y, reach_px)};
    for (const FloatVec corner : {FloatVec{-half.x, -half.y}, FloatVec{half.x, -half.y},
                                  FloatVec{-half.x, half.y}, FloatVec{half.x, half.y}}) {
        const FloatVec was = plane_point(before, corner);
        const FloatVec is = plane_point(now, corner);
        if (std::max(std::abs(was.x - is.x), std::abs(was.y - is.y)) > tuned::kFar) return true;
    }
    return false;
}

/// Returns the reference point, in px relative to `from_centre` of the hypothesis.
FloatVec reference_px(const DeviceOptions& options, const Hypothesis& hypothesis) {
    return {static_cast<float>(options.reference_dx_q8) / 256 - hypothesis.from_centre.x,
            static_cast<float>(options.reference_dy_q8) / 256 - hypothesis.from_centre.y};
}

/// Distance from `Hypothesis::from_centre` within which dots are read, in px along each axis. The
/// distance grows from round to round.
struct Reach {
    float full;  ///< distance that includes the whole image
    /// Distance within which the bits must make the position certain. Bits beyond this distance do
    /// not count as evidence for the position.
    float deciding;
    float now;  ///< distance of the current round

    Reach(const ImageView& image, const Hypothesis& hypothesis, float spacing_px)
        : full(half_side_px(image) +
               std::max(std::abs(hypothesis.from_centre.x), std::abs(hypothesis.from_centre.y)) +
               1),
          deciding(full <= tuned::kDenseAtMost * spacing_px ? full : tuned::kDense * spacing_px),
          now(deciding) {
        if (!hypothesis.is_partial_view) return;
        // A partial view may end anywhere, so the first round reads only nearby dots. These may be
        // too few for a certain position, so the deciding distance is larger.
        deciding = std::min(full, tuned::kDecidingOfPart * spacing_px);
        now = std::min(full, tuned::kDenseOfPart * spacing_px);
    }
    bool decides() const { return now == deciding; }
    void grow() { now = std::min(now * tuned::kFarther, now < deciding ? deciding : full); }
};

}  // namespace

bool is_rough(const Fix& fix) {
    const float spacing_px = static_cast<float>(fix.spacing_px_q16) / 65536.0F;
    return fix.residual_px >= std::max(tuned::kRough_px, tuned::kRough * spacing_px);
}

bool is_plausible(const ImageView& image, const FloatPlane& plane) {
    return is_within_reason(plane, static_cast<float>(image.width_px) / 2,
                            static_cast<float>(image.height_px) / 2);
}

namespace {

/// Corrects biases, fits the rotation during the readout if `w.rolling.is_fitted`, tests for uneven
/// paper, and writes the fix. Returns implausible if the rotation cannot be fitted or the fitted
/// plane is not plausible, and uncertain if the fit does not explain the frame well.
Confirmation finish(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                    const DotReader& reader, const CellsInView& view, const BitsRead& bits,
                    Hypothesis& hypothesis, PoseFit& fit, DesktopWorkspace& w) {
    FloatPlane& plane = hypothesis.pattern_from_image;
    const FloatVec bias_px2 = fit_without_bias(kernels, reader, view, image, hypothesis, fit);
    const FloatVec reference = reference_px(options, hypothesis);
    if (w.rolling.is_fitted &&
        !fit_turn(kernels, w.rolling.turn, reference, w.measured, plane, fit, w.rolling.fit)) {
        return Confirmation::implausible;
    }
    fit_uneven(kernels, w.measured, reference, plane, fit);
    add_variance(bias_px2, plane, fit);
    if (w.rolling.is_fitted) add_covariance(w.rolling.fit.pose_covariance, fit);
    if (!is_plausible(image, plane)) return Confirmation::implausible;
    if (is_implausible(fit, 2 * bits.read, bits.wrong_x + bits.wrong_y))
        return Confirmation::uncertain;
    write_fix(image, options, hypothesis, bits, fit, w);
    if (options.show_stages) show(hypothesis, w);
    return Confirmation::ok;
}

/// Tests a hypothesis: measures its dots, compares their bits with the code, and fits the pose. An
/// exact hypothesis is implausible if its bits are not clean, or if the fit still moves its plane
/// after kMaxLooks rounds (see `is_far_from`).
Confirmation measure_and_compare(const Kernels& kernels, const ImageView& image,
                                 const DeviceOptions& options, Hypothesis hypothesis,
                                 DesktopWorkspace& w) {
    FloatPlane& plane = hypothesis.pattern_from_image;
    MeasuredDots& dots = w.measured;
    const float spacing = spacing_px(plane);
    const int max_dots = std::min(std::max(options.max_dots, 64), dots.capacity());
    OtherCodes* const codes = hypothesis.is_certain ? nullptr : wanted_codes(w);
    DotReader reader(kernels, image, spacing, dots);
    PoseFit fit;
    int looks = 0;
    for (Reach reach(image, hypothesis, spacing);;) {
        const bool decides = reach.decides();
        if (!is_plausible(image, plane)) return Confirmation::implausible;
        count_from_centre(options.code, hypothesis);
        CellsInView view = cells_in_view(image, options, hypothesis, reach.now,
                                         decides ? dots.capacity() : max_dots, w);
        if (hypothesis.is_exact) view.windows = Windows::none;
        kernels.list_cells(view, dots);
        const bool is_last = reach.now >= reach.full;
        BitBlock block;
        BitsRead bits = reader.read(view, hypothesis,
                                    decides || (is_last && codes != nullptr) ? &block : nullptr);
        if (!is_plausible(bits, dots, options, min_dots(options, w), hypothesis.is_partial_view))
            return Confirmation::implausible;
        if (!is_clean(bits)) {
            if (hypothesis.is_exact) return Confirmation::implausible;
            // In the deciding round, fits the plane to all dots and reads the bits again. The new
            // plane reduces the number of misread bits.
            if (decides && !fit_to_dots(kernels, dots, bits, image, hypothesis, fit))
                return Confirmation::implausible;
            if (decides) bits = reader.read_again(hypothesis, block);
        }
        const FloatPlane before = plane;
        reader.find_centres(view, hypothesis, is_last, bits);
        if (!fit_to_dots(kernels, dots, bits, image, hypothesis, fit))
            return Confirmation::implausible;
        if (hypothesis.is_exact && is_far_from(before, plane, image, reach.now)) {
            if (++looks == tuned::kMaxLooks) return Confirmation::implausible;
            continue;
        }
        if (decides && !hypothesis.is_certain) {
            const Confirmation place =
                confirm_place(kernels, options, hypothesis, view, block, bits, w);
            const bool are_clear = bits.read == bits.seen && bits.wrong_x + bits.wrong_y == 0;
            if (place != Confirmation::ok && is_last && are_clear) {
                w.shows_too_few_cells =
                    !w.known.any() && shows_too_few_cells(kernels, options, view, dots);
                return Confirmation::too_few_bits;
            }
            if (place != Confirmation::ok) return place;
        }
        if (is_last && codes != nullptr) {
            weigh_codes_in_view(kernels, options.code, hypothesis.place, block,
                                confidences_in(bits), !decides, w.line_scores, *codes);
        }
        if (is_last) return finish(kernels, image, options, reader, view, bits, hypothesis, fit, w);
        reach.grow();
    }
}

}  // namespace

Confirmation confirm(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                     Hypothesis hypothesis, DesktopWorkspace& w) {
    if (hypothesis.is_predicted && can_sample_directly(hypothesis)) {
        OtherCodes* const codes = wanted_codes(w);
        const OtherCodes before = codes != nullptr ? *codes : OtherCodes{};
        hypothesis.is_exact = true;
        const Confirmation exact = measure_and_compare(kernels, image, options, hypothesis, w);
        if (exact == Confirmation::ok || exact == Confirmation::too_few_bits) return exact;
        hypothesis.is_exact = false;
        if (codes != nullptr)
            *codes = before;  // a rejected attempt provides no evidence about other codes
    }
    return measure_and_compare(kernels, image, options, hypothesis, w);
}

}  // namespace dotpose::core

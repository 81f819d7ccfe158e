#include "locate/confirm.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"
#include "core/integrity/codes_in_view.hpp"
#include "core/pose/covariance.hpp"
#include "core/pose/float_fit.hpp"
#include "core/pose/subgrid.hpp"
#include "core/pose/tuning.hpp"
#include "core/pose/turn_fit.hpp"
#include "core/pose/uneven.hpp"
#include "core/steps.hpp"
#include "locate/dot_reader.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::confirm;

float half_side_px(const ImageView& image) {
    return std::max(static_cast<float>(image.width_px), static_cast<float>(image.height_px)) / 2;
}

/// Returns true if all of these conditions hold:
/// - The number of dots that were read is at least `Frame::min_dots` and at least half of the
///   number of dots that were seen.
/// - Dots were seen in at least a quarter of the listed cells, or the view is partial.
/// - On each axis, at most max_bit_error_q8 / 256 of the bits disagree with the code.
bool are_plausible(const BitsRead& bits, const MeasuredDots& dots, const Frame& frame,
                   bool is_partial_view) {
    const bool is_full = 4 * bits.seen >= dots.count || is_partial_view;
    const auto exceeds_error_rate = [&](int wrong) {
        return 256 * wrong > bits.read * frame.options.integrity.max_bit_error_q8;
    };
    return bits.read >= frame.min_dots && is_full && 2 * bits.read >= bits.seen &&
           !exceeds_error_rate(bits.wrong_x) && !exceeds_error_rate(bits.wrong_y);
}

/// Returns true if the bits need no second reading: at least kClear_percent % of the dots seen were
/// read, and at most max(kMaxWrong, n / kDotsPerWrong) of their bits are wrong, where n is the
/// number of dots read.
bool is_clean(const BitsRead& bits) {
    return 100 * bits.read >= tuned::kClear_percent * bits.seen &&
           bits.wrong_x + bits.wrong_y <=
               std::max(tuned::kMaxWrong, bits.read / tuned::kDotsPerWrong);
}

/// Returns true if the fraction of visible dots that were read without a wrong bit is below
/// kMinRight, and the fraction of wrong bits among the bits read exceeds kMaxWrongInOverlay. Such a
/// frame may show two overlapping patterns whose grids are offset by a fraction of the spacing. The
/// x bits may then come from one pattern, and the y bits from the other.
bool shows_overlay(const BitsRead& bits) {
    return static_cast<float>(bits.right) < tuned::kMinRight * static_cast<float>(bits.seen) &&
           static_cast<float>(bits.wrong_x + bits.wrong_y) >
               tuned::kMaxWrongInOverlay * static_cast<float>(2 * bits.read);
}

/// Returns true if the image shows too few cells for a reliable position (see `are_too_few_cells`).
/// Overwrites the list of dots.
bool shows_too_few_cells(const Frame& frame, CellsInView view, MeasuredDots& dots) {
    view.margin_px = 0;
    frame.kernels.list_cells(view, dots);
    return are_too_few_cells(frame, dots.count);
}

/// Returns true if the image has room for fewer than `cells` cells at the spacing of the
/// hypothesis.
bool has_fewer_cells(const Frame& frame, const Hypothesis& hypothesis, float cells) {
    const float spacing = spacing_px(hypothesis.pattern_from_image);
    const auto pixels = static_cast<float>(frame.image.width_px * frame.image.height_px);
    return pixels < cells * spacing * spacing;
}

/// Returns true if the image has too few cells for a second attempt to succeed. Returns false for
/// known sheets, for which fewer cells suffice.
bool is_too_small_for_second(const Frame& frame, const Hypothesis& hypothesis) {
    return !frame.known.any() && has_fewer_cells(frame, hypothesis, tuned::kMinCellsForSecond);
}

/// Returns true if all dots seen were read, and none of their bits is wrong. In small views,
/// `is_clean` is sufficient, because a few unread or misread dots make little difference and
/// further attempts take a long time. In small views with too few cells for a second attempt, any
/// bits are accepted as clear.
bool are_clear(const Frame& frame, const Hypothesis& hypothesis, const BitsRead& bits) {
    if (hypothesis.is_small_view)
        return is_clean(bits) || is_too_small_for_second(frame, hypothesis);
    return bits.read == bits.seen && bits.wrong_x + bits.wrong_y == 0;
}

/// Returns true if the residuals of the fit are too small for a scene that rotated during the
/// readout. Only for views without a removed rotation.
bool is_still(const PoseFit& fit) {
    return fit.variance < tuning::turning::kMinResidual * tuning::turning::kMinResidual;
}

/// Returns true if the test of a hypothesis may end before its place is confirmed. Returns false in
/// small views, where a second attempt often fails, and in a series of frames, where the bits of
/// unconfirmed places are evidence for later frames.
bool may_defer(const Frame& frame, const Hypothesis& hypothesis, const PlaceEvidence& evidence) {
    return frame.defers_if_rough && !hypothesis.is_small_view && !evidence.earlier.is_in_series();
}

/// Fits the plane and the displacement to the measured dots. Returns false if the dots do not
/// determine the plane.
bool fit_to_dots(const Frame& frame, const MeasuredDots& dots, const BitsRead& bits,
                 Hypothesis& hypothesis, PoseFit& fit) {
    if (bits.right == 0) return false;
    const auto right = static_cast<float>(bits.right);
    hypothesis.displacement = bits.projected / right;
    const float limit = tuned::kOutlier * bits.squares / right + 1e-6F;
    return fit_plane(frame.kernels, dots, static_cast<int>(half_side_px(frame.image)) + 1, limit,
                     hypothesis.displacement, hypothesis.pattern_from_image, fit);
}

/// Corrects the pixel bias and the neighbour bias if they are significant, and then fits the plane
/// again. Returns the variance of the mean dot centre due to the remaining pixel bias, along u and
/// v, in px^2. Returns 0 if nothing was corrected, or if the new fit failed.
FloatVec fit_without_bias(const Frame& frame, const DotReader& reader, const CellsInView& view,
                          Hypothesis& hypothesis, PoseFit& fit) {
    FloatVec remaining_px2;
    const bool has_pixel_bias = reader.correct_pixel_bias(view, hypothesis, fit, remaining_px2);
    if (!reader.correct_neighbour_bias(hypothesis, fit) && !has_pixel_bias) return {};
    FloatPlane better = hypothesis.pattern_from_image;
    PoseFit better_fit;
    // The fit fails if too few dots remain after the correction has dropped dots at the image
    // border.
    if (!fit_plane(frame.kernels, reader.dots(), static_cast<int>(half_side_px(frame.image)) + 1,
                   tuning::fit::kOutlier * fit.variance, fit.displacement, better, better_fit)) {
        return {};
    }
    hypothesis.pattern_from_image = better;
    hypothesis.displacement = fit.displacement;
    fit = better_fit;
    return remaining_px2;
}

/// Adds the variance of the mean dot centre to the position part of the pose covariance. Converts
/// the variance from px^2 along u and v to spacings^2.
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

void write_results(const Frame& frame, const Hypothesis& hypothesis, const BitsRead& bits,
                   const PoseFit& fit, Measurement& measurement, Fix& fix) {
    const FixedVec middle_q8 = centre_q8(frame.image);
    const FloatVec from = hypothesis.from_centre;
    const FixedVec from_q8{static_cast<std::int32_t>(from.x * 256),
                           static_cast<std::int32_t>(from.y * 256)};
    const FixedVec reference = reference_q8(middle_q8, frame.options);
    PlaneFromImage& plane = measurement.pattern_from_image;
    plane = fixed_plane(hypothesis.pattern_from_image, middle_q8 + from_q8);
    measurement.hypothesis = hypothesis;
    fix.dots_seen = bits.seen;
    fix.bit_errors = bits.wrong_x + bits.wrong_y;
    fix.displacement_q16 = static_cast<std::int32_t>(fit.displacement * 65536);
    write_pose(plane, reference, frame.options.code, hypothesis.place, fix);
    estimate_covariance(fit, plane, reference, fix);
    // Predictions require a plane that is relative to the image centre.
    if (!(from_q8 == FixedVec{}))
        fix.pattern_from_image = fixed_plane(centred_plane(hypothesis), middle_q8);
    fix.status = Status::ok;
}

/// Returns true if the fit moved a corner of the measured area by more than kFar spacings along an
/// axis. The measured area is the part of the image within `reach_px` of the image centre. After
/// such a fit, the dots must be measured again, because small centroid windows do not measure large
/// offsets accurately.
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

/// Returns the reference point from the options, in px relative to `Hypothesis::from_centre`.
FloatVec reference_px(const DeviceOptions& options, const Hypothesis& hypothesis) {
    return {static_cast<float>(options.reference_dx_q8) / 256 - hypothesis.from_centre.x,
            static_cast<float>(options.reference_dy_q8) / 256 - hypothesis.from_centre.y};
}

/// Confirms the place of a hypothesis (see `confirm_place`). In small views, does so with less work
/// if `fit_uneven` will probably search for a line that divides the sheet.
bool confirm_with_reserve(const PlaceEvidence& evidence, const Hypothesis& hypothesis,
                          const CellsInView& view, const BitBlock& block, const BitsRead& bits,
                          const MeasuredDots& dots, const PoseFit& fit, Fix& fix) {
    constexpr std::size_t kWorkPerDot = 900;  // estimated cost of the search, see `WorkLimit`
    std::size_t reserve = 0;
    if (hypothesis.is_small_view &&
        may_be_divided(evidence.kernels, dots, hypothesis.pattern_from_image, fit)) {
        reserve =
            std::min(kWorkPerDot * static_cast<std::size_t>(dots.count), evidence.work.left());
    }
    evidence.work.spend(reserve);
    const bool is_confirmed = confirm_place(evidence, hypothesis, view, block, bits, fix);
    if (!is_confirmed) evidence.work.refund(reserve);
    return is_confirmed;
}

/// Distance from `Hypothesis::from_centre` within which dots are read, in px along each axis. The
/// distance grows from round to round.
struct Reach {
    float full;  ///< distance that includes the whole image
    /// Distance within which the bits must make the position certain. Bits beyond this distance are
    /// not used as evidence for the position.
    float deciding;
    float now;  ///< distance of the current round

    Reach(const ImageView& image, const Hypothesis& hypothesis, float spacing_px)
        : full(half_side_px(image) +
               std::max(std::abs(hypothesis.from_centre.x), std::abs(hypothesis.from_centre.y)) +
               1),
          deciding(full <= tuned::kDenseAtMost * spacing_px ? full : tuned::kDense * spacing_px),
          now(deciding) {
        if (!hypothesis.is_partial_view) return;
        // The pattern may end anywhere in a partial view, so the first round reads only nearby
        // dots. Their bits may be too few to make the position certain, so the position is tested
        // only in the round that reaches the deciding distance.
        deciding = std::min(full, tuned::kDecidingOfPart * spacing_px);
        now = std::min(full, tuned::kDenseOfPart * spacing_px);
    }
    bool decides() const { return now == deciding; }
    void grow() { now = std::min(now * tuned::kFarther, now < deciding ? deciding : full); }
};

/// Corrects biases, fits the rotation during the readout if a rotation was removed from the image,
/// tests for uneven paper, and writes the results. Returns implausible if the rotation cannot be
/// fitted or if the fitted plane is not plausible. Returns uncertain if the fit does not explain
/// the frame well (see `is_implausible`, `explains_few_dots` and `shows_overlay`).
Confirmation finish(const Frame& frame, const DotReader& reader, const CellsInView& view,
                    const BitsRead& bits, Hypothesis& hypothesis, PoseFit& fit,
                    Measurement& measurement, Fix& fix) {
    const Kernels& kernels = frame.kernels;
    FloatPlane& plane = hypothesis.pattern_from_image;
    const FloatVec bias_px2 = fit_without_bias(frame, reader, view, hypothesis, fit);
    const FloatVec reference = reference_px(frame.options, hypothesis);
    if (frame.removed_turn != nullptr &&
        !fit_turn(kernels, *frame.removed_turn, reference, measurement.dots, plane, fit,
                  measurement.turn)) {
        return Confirmation::implausible;
    }
    fit_uneven(kernels, measurement.dots, reference, plane, fit);
    add_variance(bias_px2, plane, fit);
    if (frame.removed_turn != nullptr) add_covariance(measurement.turn.pose_covariance, fit);
    if (!is_plausible(frame.image, plane)) return Confirmation::implausible;
    if (is_implausible(fit, 2 * bits.read, bits.wrong_x + bits.wrong_y) ||
        explains_few_dots(fit, bits.seen) || shows_overlay(bits))
        return Confirmation::uncertain;
    write_results(frame, hypothesis, bits, fit, measurement, fix);
    return Confirmation::ok;
}

/// Tests a hypothesis: measures its dots, compares their bits with the code, and fits the pose. An
/// exact hypothesis is implausible if its bits are not clean, or if kMaxLooks fits each move its
/// plane too far (see `is_far_from`).
Confirmation measure_and_compare(const Frame& frame, Hypothesis hypothesis,
                                 const PlaceEvidence& evidence, Measurement& measurement,
                                 Fix& fix) {
    const Kernels& kernels = frame.kernels;
    const ImageView& image = frame.image;
    FloatPlane& plane = hypothesis.pattern_from_image;
    MeasuredDots& dots = measurement.dots;
    const float spacing = spacing_px(plane);
    const int max_dots = std::min(std::max(frame.options.max_dots, 64), dots.capacity());
    OtherCodes* const codes = hypothesis.is_certain ? nullptr : evidence.others;
    DotReader reader(kernels, image, spacing, dots);
    PoseFit pose;
    int looks = 0;
    for (Reach reach(image, hypothesis, spacing);;) {
        const bool decides = reach.decides();
        if (!is_plausible(image, plane)) return Confirmation::implausible;
        count_from_centre(frame.options.code, hypothesis);
        CellsInView view = cells_in_view(frame, hypothesis, reach.now,
                                         decides ? dots.capacity() : max_dots, measurement.rolls);
        if (hypothesis.is_exact) view.windows = Windows::none;
        kernels.list_cells(view, dots);
        const bool is_last = reach.now >= reach.full;
        BitBlock block;
        BitsRead bits = reader.read(view, hypothesis,
                                    decides || (is_last && codes != nullptr) ? &block : nullptr);
        if (!are_plausible(bits, dots, frame, hypothesis.is_partial_view))
            return Confirmation::implausible;
        if (!is_clean(bits)) {
            if (hypothesis.is_exact) return Confirmation::implausible;
            // In the deciding round, fits the plane to all dots and reads the bits again. The new
            // plane reduces the number of misread bits.
            if (decides && !fit_to_dots(frame, dots, bits, hypothesis, pose))
                return Confirmation::implausible;
            if (decides) bits = reader.read_again(hypothesis, block);
        }
        reader.drop_cut_dots(hypothesis);
        const FloatPlane before = plane;
        reader.find_centres(view, hypothesis, is_last, bits);
        if (!fit_to_dots(frame, dots, bits, hypothesis, pose)) return Confirmation::implausible;
        if (hypothesis.is_exact && is_far_from(before, plane, image, reach.now)) {
            if (++looks == tuned::kMaxLooks) return Confirmation::implausible;
            continue;
        }
        if (decides)
            measurement.compared = {hypothesis.place.cell, 2 * bits.read,
                                    bits.wrong_x + bits.wrong_y};
        if (decides && !hypothesis.is_certain) {
            // A second attempt usually replaces a rough fix, so its place need not be confirmed.
            if (may_defer(frame, hypothesis, evidence) &&
                is_rough(std::sqrt(pose.variance) * spacing, spacing)) {
                const Confirmation finished =
                    finish(frame, reader, view, bits, hypothesis, pose, measurement, fix);
                return finished == Confirmation::ok ? Confirmation::rough : finished;
            }
            if (!confirm_with_reserve(evidence, hypothesis, view, block, bits, dots, pose, fix)) {
                // If the bits are clear but do not make the position certain, the frame has too few
                // bits.
                if (!is_last || !are_clear(frame, hypothesis, bits)) {
                    measurement.is_still = hypothesis.is_small_view && is_last && is_still(pose);
                    return Confirmation::uncertain;
                }
                measurement.shows_too_few_cells = hypothesis.reads_cut_dots ||
                                                  hypothesis.is_small_view ||
                                                  shows_too_few_cells(frame, view, dots);
                return Confirmation::too_few_bits;
            }
        }
        if (is_last && codes != nullptr) {
            weigh_codes_in_view(kernels, frame.options.code, hypothesis.place, block,
                                confidences_in(bits), !decides, evidence.line_scores, *codes);
        }
        if (is_last) return finish(frame, reader, view, bits, hypothesis, pose, measurement, fix);
        reach.grow();
    }
}

}  // namespace

bool is_rough(const Fix& fix) {
    return is_rough(fix.residual_px, static_cast<float>(fix.spacing_px_q16) / 65536.0F);
}

bool is_rough(float residual_px, float spacing_px) {
    return residual_px >= std::max(tuned::kRough_px, tuned::kRough * spacing_px);
}

bool is_plausible(const ImageView& image, const FloatPlane& plane) {
    return is_within_reason(plane, static_cast<float>(image.width_px) / 2,
                            static_cast<float>(image.height_px) / 2);
}

bool is_implausible(const PoseFit& fit, int bits, int bit_errors) {
    if (fit.displacement <= 0) return true;
    const float scatter = std::sqrt(fit.variance) / fit.displacement;
    const float contradicted = static_cast<float>(bit_errors) / static_cast<float>(bits);
    return scatter + contradicted > tuned::kMaxImplausible;
}

bool explains_few_dots(const PoseFit& fit, int dots_seen) {
    return fit.surface == Surface::uneven && 2 * fit.dots < dots_seen;
}

bool are_too_few_cells(const Frame& frame, int count) {
    if (frame.known.any()) return false;
    // Adds a margin of 1/kTolerance, because a second attempt may find a plane with a few more
    // cells in view.
    constexpr int kTolerance = 16;
    const int cells = count + count / kTolerance + 1;
    const Confidence axis = Confidence::of_hard_bits(cells, 0);
    return chance_log2(axis, odds_per_bit_q8(Confidence::of_hard_bits(2 * cells, 0))) >
           frame.options.integrity.max_p_wrong_log2;
}

Confirmation confirm(const Frame& frame, Hypothesis hypothesis, const PlaceEvidence& evidence,
                     Measurement& measurement, Fix& fix) {
    const auto measure = [&] {
        return measure_and_compare(frame, hypothesis, evidence, measurement, fix);
    };
    // Sets a flag in the hypothesis, and measures its dots. If the result is implausible or
    // uncertain, resets the flag and returns nullopt.
    const auto measure_with = [&](bool Hypothesis::*property) -> std::optional<Confirmation> {
        std::optional<OtherCodes> before;
        if (evidence.others != nullptr) before = *evidence.others;
        hypothesis.*property = true;
        const Confirmation result = measure();
        if (result != Confirmation::implausible && result != Confirmation::uncertain) return result;
        hypothesis.*property = false;
        // Restores the odds of the other codes, because a rejected result is no evidence for or
        // against them.
        if (before) *evidence.others = *before;
        return {};
    };
    const bool has_few = has_fewer_cells(frame, hypothesis, tuned::kMaxCellsWithCutDots);
    hypothesis.is_small_view = has_few && is_small(frame.image);
    if (has_few && !hypothesis.is_partial_view && !hypothesis.is_certain) {
        if (const auto result = measure_with(&Hypothesis::reads_cut_dots)) return *result;
    }
    if (hypothesis.is_predicted && can_sample_directly(hypothesis)) {
        if (const auto result = measure_with(&Hypothesis::is_exact)) return *result;
    }
    return measure();
}

}  // namespace dotpose::core

#include "locate/turning.hpp"

#include <algorithm>
#include <cmath>

#include "core/detect/derotate.hpp"
#include "core/detect/patch.hpp"
#include "core/detect/undistort.hpp"
#include "core/lattice/outwards.hpp"
#include "core/pose/float_fit.hpp"
#include "core/steps.hpp"
#include "locate/patch_hypothesis.hpp"
#include "locate/trace.hpp"
#include "locate/tracked.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::turning;

bool has_room(const ImageView& image, std::span<const std::uint8_t> pixels) {
    return static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px) <=
           pixels.size();
}

/// Returns the centre of the rotation that is removed from an image. This is the distortion centre,
/// because a rotation about the distortion centre does not change the distortion of a point. A
/// rotation about any other point differs by a translation, which is part of the drift.
FloatVec axis_of(const FixedLens& lens) {
    if (lens.k_q40 == 0) return {};
    return {static_cast<float>(lens.centre_dx_q8) / 256,
            static_cast<float>(lens.centre_dy_q8) / 256};
}

/// Returns the maximum rotation, in rad per row. The rotation during the whole readout is at most
/// kMaxTurn_rad. While a row is read, the scene at the left or right image border moves down by at
/// most kMaxFall rows. If it moved down by a whole row, several rows would show the same part of
/// the scene.
float max_rad_per_row(const ImageView& image) {
    return std::min(tuned::kMaxTurn_rad / static_cast<float>(image.height_px),
                    tuned::kMaxFall / (static_cast<float>(image.width_px) / 2));
}

/// Returns the distance, in px, by which a rotation of 1 rad per row moves the dots in the corners
/// of an area around the image centre.
float corner_px_per_turn(int width_px, int height_px) {
    const float half_width = static_cast<float>(width_px) / 2;
    const float half_height = static_cast<float>(height_px) / 2;
    return half_height * std::sqrt(half_width * half_width + half_height * half_height);
}

float distance(FloatVec a, FloatVec b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
}

/// Returns true if the rotation and the drift (see ReadoutTurn) are in range. Returns false if
/// either is NaN.
bool is_possible(const ReadoutTurn& turn, const ImageView& image) {
    return std::abs(turn.rad_per_row) <= max_rad_per_row(image) &&
           std::abs(turn.drift.x) <= tuned::kMaxDrift && std::abs(turn.drift.y) <= tuned::kMaxDrift;
}

/// Searches for the rotation at which the dots of a patch agree best with a grid.
class TurnSearch {
  public:
    /// The coordinates of the dots in the patch must be undistorted (see `undistort`).
    TurnSearch(const Frame& frame, Patch& patch)
        : frame_(frame),
          view_(whole_view(patch)),
          patch_(patch),
          seen_(patch.dots),
          middle_(middle_of(patch, frame.image)) {
        view_.min_dots = frame.min_dots;
        turn_.axis = axis_of(frame.options.lens);
        step_ = tuned::kStep * view_.spacing_px /
                corner_px_per_turn(patch_.width_px * patch_.scale, patch_.height_px * patch_.scale);
    }

    float step() const { return step_; }
    /// If `is_skewed` is true, cells may be arbitrary parallelograms. Otherwise, cells must be
    /// approximately square.
    void accept_skewed(bool is_skewed) { view_.is_skewed = is_skewed; }

    /// Improves a rotation by hill climbing with decreasing steps, to maximise the agreement of the
    /// dots with a grid. Afterwards, `turn` and `grid` return the best rotation and its grid, and
    /// this rotation is removed from the dots of the patch. Returns false if the dots do not form a
    /// grid at the initial rotation.
    bool climb(float rad_per_row, FloatVec drift) {
        turn_.rad_per_row = rad_per_row;
        turn_.drift = drift;
        if (!fits(turn_, grid_)) return false;
        const float finest = step_ / tuned::kStepParts;
        for (float step = step_; step > finest;) {
            if (!improves(step) && !improves(-step) && !improves(0)) step /= 2;
        }
        // Derotates the dots of the patch by the best rotation, because the last rotation tried may
        // not be the best.
        PatchGrid last;
        return fits(turn_, last);
    }

    const ReadoutTurn& turn() const { return turn_; }
    const PatchGrid& grid() const { return grid_; }

  private:
    bool fits(const ReadoutTurn& turn, PatchGrid& grid) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(seen_.count); ++i) {
            const FloatVec at = turn.without_turn({seen_.x[i] + middle_.x, seen_.y[i] + middle_.y});
            patch_.dots.x[i] = at.x - middle_.x;
            patch_.dots.y[i] = at.y - middle_.y;
        }
        return find_grid(frame_.kernels, patch_, view_, grid);
    }

    /// Tries a rotation that is larger by `step`, with the drift of the best grid so far. If the
    /// new grid is better, stores the rotation and the grid, and returns true.
    bool improves(float step) {
        ReadoutTurn turn = turn_;
        turn.rad_per_row += step;
        turn.drift = drift_of(grid_.grid_from_image);
        PatchGrid grid;
        if (!is_possible(turn, frame_.image) || !fits(turn, grid) ||
            grid.agreement <= tuned::kBetter * grid_.agreement)
            return false;
        turn_ = turn;
        grid_ = grid;
        return true;
    }

    const Frame& frame_;
    PatchView view_;
    Patch& patch_;
    PatchDots seen_;
    FloatVec middle_;
    float step_ = 0;
    ReadoutTurn turn_;
    PatchGrid grid_;
};

/// Maps dots from the derotated image back to the original image.
void show_in_original(const ReadoutTurn& turn, const ImageView& image, const FixedLens& lens,
                      std::span<DetectedDot> dots) {
    const FixedVec middle_q8 = centre_q8(image);
    for (DetectedDot& dot : dots) {
        const FixedVec at_q8 = distorted(lens, middle_q8, dot.centre_q8) - middle_q8;
        const FloatVec at{static_cast<float>(at_q8.x) / 256, static_cast<float>(at_q8.y) / 256};
        const FloatVec seen = turn.seen_from(at, at.y, 6);
        const FixedVec seen_q8{static_cast<std::int32_t>(std::floor(seen.x * 256 + 0.5F)),
                               static_cast<std::int32_t>(std::floor(seen.y * 256 + 0.5F))};
        dot.centre_q8 = undistorted(lens, middle_q8, middle_q8 + seen_q8);
    }
}

/// Stores the results of an attempt for the trace, and writes the rotation into the fix.
void store_turning(const Frame& frame, const ReadoutTurn& turn, const Measurement& measurement,
                   Workspace& w) {
    w.fix.readout_turn_rad = -turn.rad_per_row * static_cast<float>(frame.image.height_px);
    store_for_trace(measurement, frame.options.show_stages, w);
    show_in_original(turn, frame.image, frame.options.lens, first(w.dots, w.dot_count));
}

/// Returns true if the rotation explains a significant fraction of the squared residuals of a fit
/// without rotation: at least about a fifth, or three fifths if the remaining residuals are
/// correlated (see kMinGainIfEven and kMinGain). Correlated residuals need the larger fraction,
/// because a wrinkled sheet may cause residuals similar to those of a rotation.
bool is_significant(const TurnFit& fit, int dots, Surface surface) {
    const float min_gain = surface == Surface::even ? tuned::kMinGainIfEven : tuned::kMinGain;
    return fit.turn.rad_per_row * fit.turn.rad_per_row >=
           min_gain * static_cast<float>(dots) * fit.variance;
}

/// Removes the rotation `turn` from the frame, and passes the result to `locate`, which must call
/// `confirm` to fit the rotation to the measured dots. Repeats this with the fitted rotation until
/// the rotation changes so little that the dots in the image corners move by less than kSettled_px.
/// Sets `turn` to the fitted rotation. `pixels` is memory for the derotated image. If `locate`
/// returns a result other than ok, returns this result. Returns implausible if a fitted rotation is
/// out of range, or if the rotation still changes after kMaxRounds rounds.
template <typename Locate>
Confirmation settle(const Frame& frame, std::span<std::uint8_t> pixels,
                    const Measurement& measurement, ReadoutTurn& turn, Locate locate) {
    const ImageView& image = frame.image;
    const float corner_px = corner_px_per_turn(image.width_px, image.height_px);
    for (int round = 0; round < tuned::kMaxRounds; ++round) {
        const ReadoutTurn before = turn;
        Frame still = frame;
        still.image = derotated(image, before, pixels);
        still.removed_turn = &before;
        const Confirmation confirmation = locate(still);
        if (confirmation != Confirmation::ok) return confirmation;
        turn = measurement.turn.turn;
        if (!is_possible(turn, image)) break;
        const float moved = std::abs(turn.rad_per_row - before.rad_per_row) +
                            std::abs(turn.rad_per_row) * distance(turn.drift, before.drift);
        if (moved * corner_px < tuned::kSettled_px) return Confirmation::ok;
    }
    return Confirmation::implausible;
}

/// Searches for a grid with a place in the code, first at the rotation `turn` if it is not 0, and
/// then at rotations of increasing magnitude. Sets `turn` to the rotation of the grid that is
/// found. Returns nullopt if none of the first kMaxClimbs grids has a place in the code, or if the
/// maximum rotation is reached first.
std::optional<Hypothesis> find_turning_hypothesis(const Frame& frame, const Patch& patch,
                                                  const PlaceEvidence& evidence, TurnSearch& search,
                                                  ReadoutTurn& turn) {
    const float max = max_rad_per_row(frame.image);
    int climbs_left = tuned::kMaxClimbs;
    for (int i = turn.rad_per_row == 0 ? 0 : -1; climbs_left > 0; ++i) {
        const float size = static_cast<float>((i + 1) / 2) * search.step();
        if (size > max) break;
        const bool is_grid = i < 0 ? search.climb(turn.rad_per_row, turn.drift)
                                   : search.climb(i % 2 == 0 ? size : -size, {});
        if (!is_grid || search.grid().variance > tuning::patch_grid::kMaxVariance) continue;
        --climbs_left;
        auto hypothesis = read_grid(patch, search.grid(), middle_of(patch, frame.image), evidence,
                                    PlaceSearch::thorough);
        if (!hypothesis) continue;
        move_origin_to_centre(*hypothesis);
        turn = search.turn();
        return hypothesis;
    }
    return {};
}

/// Searches the dots of the patch for a grid of square cells, and then for a grid of arbitrary
/// parallelograms. Returns nullopt if there is no grid with a place in the code.
std::optional<Hypothesis> search_patch(const Frame& frame, const PlaceEvidence& evidence,
                                       Patch& patch, ReadoutTurn& turn) {
    undistort(frame.options.lens, middle_of(patch, frame.image), patch.dots);
    TurnSearch search(frame, patch);
    for (const bool is_skewed : {false, true}) {
        search.accept_skewed(is_skewed);
        const auto hypothesis = find_turning_hypothesis(frame, patch, evidence, search, turn);
        if (hypothesis) return hypothesis;
    }
    return {};
}

/// Finds the isolated dots of a patch. Returns false if the patch has no contrast, or if the
/// fraction of isolated dots is less than kMinIsolated. In the latter case, the first attempt
/// probably failed because of noise and dirt, not because of a rotation.
bool find_isolated_dots(const Frame& frame, Patch& patch, Fix& fix) {
    if (!find_patch_dots(frame, patch, fix)) return false;
    const int seen = patch.dots.count;
    keep_isolated(patch);
    return static_cast<float>(patch.dots.count) >= tuned::kMinIsolated * static_cast<float>(seen);
}

/// Measures the dots of a hypothesis in the derotated image, and fits the rotation (see `settle`).
/// Returns implausible if the fitted rotation is not significant.
Confirmation confirm_turning(const Frame& frame, Hypothesis hypothesis,
                             const PlaceEvidence& evidence, std::span<std::uint8_t> pixels,
                             ReadoutTurn& turn, Measurement& measurement, Fix& fix) {
    const Confirmation confirmation =
        settle(frame, pixels, measurement, turn, [&](const Frame& still) {
            const Confirmation c = confirm(still, hypothesis, evidence, measurement, fix);
            hypothesis.pattern_from_image = float_plane(fix.pattern_from_image);
            hypothesis.place = fix.place;
            hypothesis.is_certain = true;
            return c;
        });
    if (confirmation != Confirmation::ok) return confirmation;
    return is_significant(measurement.turn, fix.dots_used, fix.surface) ? Confirmation::ok
                                                                        : Confirmation::implausible;
}

}  // namespace

bool shows_turn(const Frame& frame, const Fix& fix, std::span<const std::uint8_t> pixels,
                Measurement& measurement, ReadoutTurn& fitted) {
    fitted = {};
    if ((fix.surface == Surface::even && !is_rough(fix)) || !has_room(frame.image, pixels))
        return false;
    // If the dots were measured around a point other than the image centre, the rotation cannot be
    // fitted to them. Only a search can then detect a rotation, and it is worthwhile if the fix is
    // rough.
    if (!(fix.pattern_from_image.centre_q8 == measurement.pattern_from_image.centre_q8))
        return is_rough(fix);
    // Fits the plane again, because the fix may use only one side of a divided sheet.
    const float displacement = static_cast<float>(fix.displacement_q16) / 65536;
    FloatPlane plane = float_plane(fix.pattern_from_image);
    PoseFit fit;
    TurnFit turn;
    MeasuredDots& dots = measurement.dots;
    const int reach_px = std::max(frame.image.width_px, frame.image.height_px) / 2 + 1;
    const float limit = displacement * displacement;
    const ReadoutTurn none{0, axis_of(frame.options.lens), drift_of(plane)};
    const bool is_turning =
        gain_of_turn(none, static_cast<float>(reach_px), dots, plane, displacement, limit) >=
            tuned::kMinQuickGain &&
        fit_plane(frame.kernels, dots, reach_px, limit, displacement, plane, fit) &&
        fit_turn(frame.kernels, {0, none.axis, drift_of(plane)}, {}, dots, plane, fit, turn) &&
        is_significant(turn, fit.dots, Surface::even);
    if (is_turning && is_possible(turn.turn, frame.image)) {
        fitted = turn.turn;
        measurement.hypothesis.pattern_from_image = plane;
    }
    return is_turning;
}

bool locate_turning(const Frame& frame, const ReadoutTurn& fitted, DesktopWorkspace& w) {
    if (!has_room(frame.image, w.rolling_pixels)) return false;
    const Fix before = w.fix;
    const PlaceEvidence evidence = w.evidence(frame);
    // Tests a hypothesis with the given rotation, and stores the fix if it is confirmed.
    const auto test = [&](const Hypothesis& hypothesis, ReadoutTurn turn) {
        const Confirmation confirmation = confirm_turning(
            frame, hypothesis, evidence, w.rolling_pixels, turn, w.measurement, w.fix);
        if (confirmation != Confirmation::ok) return confirmation;
        w.fix.attempt = Attempt::first;
        store_turning(frame, turn, w.measurement, w);
        return confirmation;
    };
    if (fitted.rad_per_row != 0 && test(w.measurement.hypothesis, fitted) == Confirmation::ok)
        return true;
    ReadoutTurn turn;
    for (const int scale : {1, 2, 4}) {
        if (!place_patch_in_middle(frame.image, scale, *w.patch)) break;
        if (!find_isolated_dots(frame, *w.patch, w.fix)) continue;
        const auto hypothesis = search_patch(frame, evidence, *w.patch, turn);
        if (!hypothesis) continue;
        const Confirmation confirmation = test(*hypothesis, turn);
        if (confirmation == Confirmation::ok) return true;
        if (confirmation == Confirmation::uncertain) break;
    }
    w.fix = before;
    return false;
}

bool locate_tracked_turning(const Frame& frame, const Prediction& prediction, DesktopWorkspace& w) {
    if (!has_room(frame.image, w.rolling_pixels)) return false;
    ReadoutTurn turn;
    turn.axis = axis_of(frame.options.lens);
    turn.rad_per_row = -prediction.readout_turn_rad / static_cast<float>(frame.image.height_px);
    turn.drift = drift_of(float_plane(prediction.pattern_from_image));
    if (!is_possible(turn, frame.image)) return false;
    forget_frame(w);
    const PlaceEvidence evidence = w.evidence(frame);
    Prediction next = prediction;
    const auto locate = [&](const Frame& still) {
        w.fix = {};
        if (!confirm_prediction(still, next, evidence, w.measurement, w.fix))
            return Confirmation::implausible;
        next = Prediction::like(w.fix);
        return Confirmation::ok;
    };
    if (settle(frame, w.rolling_pixels, w.measurement, turn, locate) != Confirmation::ok)
        return false;
    store_turning(frame, turn, w.measurement, w);
    // If the rotation is not significant, the next frame is predicted without a rotation.
    if (!is_significant(w.measurement.turn, w.fix.dots_used, w.fix.surface))
        w.fix.readout_turn_rad = 0;
    return true;
}

}  // namespace dotpose::core

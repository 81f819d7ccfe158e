#include "locate/turning.hpp"

#include <algorithm>
#include <cmath>

#include "core/detect/derotate.hpp"
#include "core/detect/patch.hpp"
#include "core/detect/undistort.hpp"
#include "core/lattice/outwards.hpp"
#include "core/pose/float_fit.hpp"
#include "locate/confirm.hpp"
#include "locate/patch_hypothesis.hpp"
#include "locate/tracked.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::turning;

bool has_room(const ImageView& image, const DesktopWorkspace& w) {
    return static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px) <=
           w.rolling.memory.size();
}

/// Returns the centre of the rotation that is removed from an image. This is the distortion centre,
/// because a rotation about the distortion centre does not change the distortion of a point. A
/// rotation about any other point differs by a translation, which is part of the drift.
FloatVec axis_of(const FixedLens& lens) {
    if (lens.k_q40 == 0) return {};
    return {static_cast<float>(lens.centre_dx_q8) / 256,
            static_cast<float>(lens.centre_dy_q8) / 256};
}

/// Returns the maximum rotation, in rad per row. At faster rotations, the scene would move down
/// nearly as fast as the rows are read.
float max_rad_per_row(const ImageView& image) {
    return std::min(tuned::kMaxTurn_rad / static_cast<float>(image.height_px),
                    tuned::kMaxFall / (static_cast<float>(image.width_px) / 2));
}

/// Returns the motion of the dots in the corners of an area around the image centre, in px, for a
/// rotation of 1 rad per row.
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
    /// The dots in the patch must be undistorted.
    TurnSearch(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
               const PatchView& view, DesktopWorkspace& w)
        : kernels_(kernels),
          image_(image),
          view_(view),
          patch_(*w.patch),
          seen_(w.patch->dots),
          middle_(middle_of(*w.patch, image)) {
        turn_.axis = axis_of(options.lens);
        step_ = tuned::kStep * view.spacing_px /
                corner_px_per_turn(patch_.width_px * patch_.scale, patch_.height_px * patch_.scale);
    }

    float step() const { return step_; }
    /// Sets whether cells may be arbitrary parallelograms. Otherwise, cells must be about square.
    void accept_skewed(bool is_skewed) { view_.is_skewed = is_skewed; }

    /// Searches from a rotation in decreasing steps. Returns false if the dots do not form a grid
    /// at the first rotation.
    bool climb(float rad_per_row, FloatVec drift) {
        turn_.rad_per_row = rad_per_row;
        turn_.drift = drift;
        if (!fits(turn_, grid_)) return false;
        const float finest = step_ / tuned::kStepParts;
        for (float step = step_; step > finest;) {
            if (!improves(step) && !improves(-step) && !improves(0)) step /= 2;
        }
        // Removes the best rotation from the dots of the patch.
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
        return find_grid(kernels_, patch_, view_, grid);
    }

    /// Tries a rotation that is larger by `step`, with the drift of the best grid so far. Returns
    /// true if the grid is better.
    bool improves(float step) {
        ReadoutTurn turn = turn_;
        turn.rad_per_row += step;
        turn.drift = drift_of(grid_.grid_from_image);
        PatchGrid grid;
        if (!is_possible(turn, image_) || !fits(turn, grid) ||
            grid.agreement <= tuned::kBetter * grid_.agreement)
            return false;
        turn_ = turn;
        grid_ = grid;
        return true;
    }

    const Kernels& kernels_;
    const ImageView& image_;
    PatchView view_;
    Patch& patch_;
    PatchDots seen_;
    FloatVec middle_;
    float step_ = 0;
    ReadoutTurn turn_;
    PatchGrid grid_;
};

/// Writes the rotation into the fix. Converts the dots of the trace to the original image.
void write_turn(const ReadoutTurn& turn, const ImageView& image, const FixedLens& lens,
                DesktopWorkspace& w) {
    w.fix.readout_turn_rad = -turn.rad_per_row * static_cast<float>(image.height_px);
    const FixedVec centre_q8{(image.width_px - 1) * 128, (image.height_px - 1) * 128};
    for (DetectedDot& dot : w.dots.first(static_cast<std::size_t>(w.dot_count))) {
        const FixedVec at_q8 = distorted(lens, centre_q8, dot.centre_q8) - centre_q8;
        const FloatVec at{static_cast<float>(at_q8.x) / 256, static_cast<float>(at_q8.y) / 256};
        const FloatVec seen = turn.seen_from(at, at.y, 6);
        const FixedVec seen_q8{static_cast<std::int32_t>(std::floor(seen.x * 256 + 0.5F)),
                               static_cast<std::int32_t>(std::floor(seen.y * 256 + 0.5F))};
        dot.centre_q8 = undistorted(lens, centre_q8, centre_q8 + seen_q8);
    }
}

/// Returns true if the rotation explains enough of the squared residuals that the dots have without
/// the rotation: about a fifth, or three fifths if the remaining residuals are correlated (see
/// kMinGainIfEven and kMinGain). The residuals of a wrinkled sheet may be similar to those of a
/// rotation.
bool is_significant(const TurnFit& fit, int dots, Surface surface) {
    const float min_gain = surface == Surface::even ? tuned::kMinGainIfEven : tuned::kMinGain;
    return fit.turn.rad_per_row * fit.turn.rad_per_row >=
           min_gain * static_cast<float>(dots) * fit.variance;
}

/// Calls `locate(view)` with the image from which the rotation is removed. Then fits the rotation
/// to the measured dots. Repeats both steps until the rotation no longer changes. Sets `turn` to
/// the rotation.
template <typename Locate>
Confirmation settle(const ImageView& image, DesktopWorkspace& w, ReadoutTurn& turn, Locate locate) {
    RollingImage& rolling = w.rolling;
    const float corner_px = corner_px_per_turn(image.width_px, image.height_px);
    Confirmation confirmation = Confirmation::implausible;
    for (int round = 0; round < tuned::kMaxRounds; ++round) {
        rolling.turn = turn;
        rolling.fit = {};
        rolling.is_fitted = true;
        confirmation = locate(derotated(image, turn, rolling.memory));
        rolling.is_fitted = false;
        if (confirmation != Confirmation::ok) return confirmation;
        const ReadoutTurn before = turn;
        turn = rolling.fit.turn;
        if (!is_possible(turn, image)) break;
        const float moved = std::abs(turn.rad_per_row - before.rad_per_row) +
                            std::abs(turn.rad_per_row) * distance(turn.drift, before.drift);
        if (moved * corner_px < tuned::kSettled_px) return Confirmation::ok;
    }
    return Confirmation::implausible;
}

/// Measures the dots of a hypothesis in the image from which the rotation is removed.
Confirmation confirm_turning(const Kernels& kernels, const ImageView& image,
                             const DeviceOptions& options, Hypothesis hypothesis, ReadoutTurn turn,
                             DesktopWorkspace& w) {
    const Confirmation confirmation = settle(image, w, turn, [&](const ImageView& still) {
        const Confirmation c = confirm(kernels, still, options, hypothesis, w);
        hypothesis.pattern_from_image = float_plane(w.fix.pattern_from_image);
        hypothesis.place = w.fix.place;
        hypothesis.is_certain = true;
        return c;
    });
    if (confirmation != Confirmation::ok) return confirmation;
    if (!is_significant(w.rolling.fit, w.fix.dots_used, w.fix.surface))
        return Confirmation::implausible;
    write_turn(turn, image, options.lens, w);
    return Confirmation::ok;
}

/// Searches for a grid with a place in the code, first at the rotation `turn` and then at rotations
/// of increasing size. Sets `turn` to the rotation of this grid. Returns false if there is no such
/// grid.
bool find_turning_hypothesis(const Kernels& kernels, const ImageView& image,
                             const DeviceOptions& options, TurnSearch& search, DesktopWorkspace& w,
                             ReadoutTurn& turn, Hypothesis& hypothesis) {
    const FloatVec middle = middle_of(*w.patch, image);
    const float max = max_rad_per_row(image);
    int climbs_left = tuned::kMaxClimbs;
    for (int i = turn.rad_per_row == 0 ? 0 : -1; climbs_left > 0; ++i) {
        const float size = static_cast<float>((i + 1) / 2) * search.step();
        if (size > max) break;
        const bool is_grid = i < 0 ? search.climb(turn.rad_per_row, turn.drift)
                                   : search.climb(i % 2 == 0 ? size : -size, {});
        if (!is_grid || search.grid().variance > tuned::kMaxVariance) continue;
        --climbs_left;
        if (!read_grid(kernels, options, search.grid(), middle, w, hypothesis)) continue;
        hypothesis.pattern_from_image =
            recentred(hypothesis.pattern_from_image, {-middle.x, -middle.y});
        hypothesis.from_centre = {};
        turn = search.turn();
        return true;
    }
    return false;
}

/// Searches the dots of the patch for a grid of square cells, and then for a grid of arbitrary
/// parallelograms. Confirms the hypothesis.
Confirmation locate_turning_in_patch(const Kernels& kernels, const ImageView& image,
                                     const DeviceOptions& options, DesktopWorkspace& w,
                                     ReadoutTurn& turn) {
    PatchDots& dots = w.patch->dots;
    if (options.lens.k_q40 != 0) undistort(options.lens, middle_of(*w.patch, image), dots);
    PatchView view = whole_view(*w.patch);
    view.min_dots = min_dots(options, w);
    TurnSearch search(kernels, image, options, view, w);
    for (const bool is_skewed : {false, true}) {
        search.accept_skewed(is_skewed);
        Hypothesis hypothesis;
        if (find_turning_hypothesis(kernels, image, options, search, w, turn, hypothesis))
            return confirm_turning(kernels, image, options, hypothesis, turn, w);
    }
    return Confirmation::implausible;
}

}  // namespace

bool shows_turn(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                DesktopWorkspace& w) {
    const Fix& fix = w.fix;
    if ((fix.surface == Surface::even && !is_rough(fix)) || !has_room(image, w)) return false;
    // If the dots were measured around a point other than the image centre, only the search can
    // detect a rotation.
    if (!(fix.pattern_from_image.centre_q8 == w.pattern_from_image.centre_q8)) return is_rough(fix);
    // Fits the plane again, because the fix may use only one side of a divided sheet.
    const float displacement = static_cast<float>(fix.displacement_q16) / 65536;
    FloatPlane plane = float_plane(fix.pattern_from_image);
    PoseFit fit;
    TurnFit turn;
    return fit_plane(kernels, w.measured, std::max(image.width_px, image.height_px) / 2 + 1,
                     displacement * displacement, displacement, plane, fit) &&
           fit_turn(kernels, {0, axis_of(options.lens), drift_of(plane)}, {}, w.measured, plane,
                    fit, turn) &&
           is_significant(turn, fit.dots, Surface::even);
}

bool locate_turning(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                    DesktopWorkspace& w) {
    if (!has_room(image, w)) return false;
    const Fix before = w.fix;
    ReadoutTurn turn;
    for (const int scale : {1, 2, 4}) {
        if (!place_patch(image, {image.width_px / 2, image.height_px / 2}, scale, w)) break;
        if (!find_patch_dots(kernels, image, options, w)) continue;
        const int seen = w.patch->dots.count;
        keep_isolated(*w.patch);
        if (static_cast<float>(w.patch->dots.count) <
            tuned::kMinIsolated * static_cast<float>(seen))
            continue;
        const Confirmation confirmation = locate_turning_in_patch(kernels, image, options, w, turn);
        if (confirmation == Confirmation::ok) {
            w.fix.attempt = Attempt::first;
            return true;
        }
        if (confirmation == Confirmation::uncertain) break;
    }
    w.fix = before;
    return false;
}

bool locate_tracked_turning(const Kernels& kernels, const ImageView& image,
                            const DeviceOptions& options, const Prediction& prediction,
                            DesktopWorkspace& w) {
    if (!has_room(image, w)) return false;
    ReadoutTurn turn;
    turn.axis = axis_of(options.lens);
    turn.rad_per_row = -prediction.readout_turn_rad / static_cast<float>(image.height_px);
    turn.drift = drift_of(float_plane(prediction.pattern_from_image));
    if (!is_possible(turn, image)) return false;
    Prediction next = prediction;
    const Confirmation confirmation = settle(image, w, turn, [&](const ImageView& still) {
        const bool is_located = locate_tracked(kernels, still, options, next, w);
        if (is_located) next = Prediction::like(w.fix);
        return is_located ? Confirmation::ok : Confirmation::implausible;
    });
    if (confirmation != Confirmation::ok) return false;
    write_turn(turn, image, options.lens, w);
    // Without a significant rotation, the next frame is predicted without a rotation.
    if (!is_significant(w.rolling.fit, w.fix.dots_used, w.fix.surface)) w.fix.readout_turn_rad = 0;
    return true;
}

}  // namespace dotpose::core

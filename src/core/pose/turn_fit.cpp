#include "core/pose/turn_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/fit/normal_equations.hpp"
#include "core/pose/dot_offsets.hpp"
#include "core/pose/float_fit.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::turn;

using Vec3 = std::array<float, 3>;
using Matrix3 = std::array<Vec3, 3>;

float limit_of(const PoseFit& fit) {
    return tuning::fit::kOutlier * fit.variance;
}

/// Converts a dot centre from one derotated image to another. `from` is the rotation that was
/// removed from the first image, and `to` is the rotation that was removed from the second image.
FloatVec transferred(const ReadoutTurn& from, const ReadoutTurn& to, FloatVec dot) {
    constexpr int kSteps = 4;
    return to.without_turn(from.seen_from(dot, dot.y, kSteps));
}

void transfer(const ReadoutTurn& from, const ReadoutTurn& to, MeasuredDots& dots) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const FloatVec at = transferred(from, to, {dots.x[k], dots.y[k]});
        dots.x[k] = at.x;
        dots.y[k] = at.y;
    }
}

/// Returns the pose at the reference point for the plane `to`, minus the pose for the plane `from`.
Vec3 change_of_pose(const FloatPlane& from, const FloatPlane& to, FloatVec reference_px) {
    const FloatPlane a = recentred(from, reference_px);
    const FloatPlane b = recentred(to, reference_px);
    return {b.at_x - a.at_x, b.at_y - a.at_y,
            (a.du_x * b.du_y - a.du_y * b.du_x) / (a.du_x * a.du_x + a.du_y * a.du_y)};
}

/// A rotation in which one parameter is changed slightly, and the plane fitted to the dots after
/// this change.
struct Trial {
    ReadoutTurn turn;
    float step = 0;
    FloatPlane plane;
    PoseFit fit;
};

/// Returns the residual of dot `k` in a trial. The dot was measured in the image from which the
/// rotation `turn` was removed.
FloatVec residual_in(const Trial& trial, const ReadoutTurn& turn, std::size_t k,
                     MeasuredDots& dots) {
    const FloatVec at{dots.x[k], dots.y[k]};
    const FloatVec moved = transferred(turn, trial.turn, at);
    dots.x[k] = moved.x;
    dots.y[k] = moved.y;
    const FloatVec residual = dot_offset(dots, k, trial.plane, trial.fit.displacement).residual;
    dots.x[k] = at.x;
    dots.y[k] = at.y;
    return residual;
}

/// Returns the standard deviation of the drift that `drift_of` computes from the plane, in px per
/// row. A tilted camera foreshortens the paper, which looks like a drift. The foreshortening is
/// proportional to the square of the tilt, and therefore to the square of the perspective.
float deviation_of_drift(const FloatPlane& plane, float reach_px) {
    const float squared_tilt = plane.tilt_x * plane.tilt_x + plane.tilt_y * plane.tilt_y;
    return std::min(tuned::kDrift + tuned::kDriftOfTilt * squared_tilt * reach_px * reach_px,
                    tuned::kMaxDrift);
}

/// Inverts a positive definite matrix by Gauss-Jordan elimination. Returns false if it is singular.
bool invert(Matrix3& m) {
    for (std::size_t k = 0; k < 3; ++k) {
        const float pivot = m[k][k];
        if (!(pivot > 0)) return false;
        m[k][k] = 1;
        for (float& value : m[k])
            value /= pivot;
        for (std::size_t i = 0; i < 3; ++i) {
            if (i == k) continue;
            const float factor = m[i][k];
            m[i][k] = 0;
            for (std::size_t j = 0; j < 3; ++j)
                m[i][j] -= factor * m[k][j];
        }
    }
    return true;
}

/// Regression of residuals on small changes of a plane, and on a rotation.
class TurnRegression {
  public:
    /// Adds a dot at `at`, in spacings. `moved` is the change of its residual per unit of rotation.
    void add(FloatVec at, FloatVec residual, FloatVec moved) {
        equations_.add({1, at.x, at.y, 0, 0, 0, at.x * at.x, at.x * at.y, moved.x}, residual.x, 1);
        equations_.add({0, 0, 0, 1, at.x, at.y, at.x * at.y, at.y * at.y, moved.y}, residual.y, 1);
        squares_ += residual.x * residual.x + residual.y * residual.y;
    }
    /// Returns the result of `gain_of_turn`.
    float gain() {
        constexpr float kDetermined = 1e-4F;
        equations_.decompose(kDetermined, 0);
        const auto explained = equations_.whitened(equations_.right());
        float remaining = squares_;
        for (const float part : explained)
            remaining -= part * part;
        const float by_turn = explained.back() * explained.back();
        return remaining > 0 ? 2 * by_turn / remaining : 0;
    }

  private:
    /// Parameters: the affine change of x and that of y (three each), the change of the tilt (two),
    /// and the rotation.
    NormalEquations<9> equations_;
    float squares_ = 0;
};

}  // namespace

float gain_of_turn(const ReadoutTurn& turn, float reach_px, const MeasuredDots& dots,
                   const FloatPlane& plane, float displacement, float limit) {
    ReadoutTurn step = turn;
    step.rad_per_row = tuned::kStep_px / (reach_px * reach_px);
    const FloatVec centre = plane_point(plane, {});
    TurnRegression regression;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const DotOffset dot = dot_offset(dots, k, plane, displacement);
        if (!(dot.squared() <= limit)) continue;
        const FloatVec moved = plane_point(plane, step.without_turn({dots.x[k], dots.y[k]}));
        regression.add({dot.at.x - centre.x, dot.at.y - centre.y}, dot.residual,
                       {moved.x - dot.at.x, moved.y - dot.at.y});
    }
    return regression.gain();
}

bool fit_turn(const Kernels& kernels, const ReadoutTurn& turn, FloatVec reference_px,
              MeasuredDots& dots, FloatPlane& plane, PoseFit& fit, TurnFit& result) {
    const auto reach = static_cast<float>(fit.reach_px);
    const float turn_step = tuned::kStep_px / (reach * reach);
    std::array<Trial, 3> trials;
    trials.fill({turn, tuned::kDriftStep, plane, fit});
    trials[0].step = turn_step;
    trials[0].turn.rad_per_row += turn_step;
    trials[1].turn.drift.x += tuned::kDriftStep;
    trials[2].turn.drift.y += tuned::kDriftStep;
    for (Trial& trial : trials) {
        transfer(turn, trial.turn, dots);
        const bool is_fitted = fit_plane(kernels, dots, fit.reach_px, 2 * limit_of(fit),
                                         fit.displacement, trial.plane, trial.fit);
        transfer(trial.turn, turn, dots);
        if (!is_fitted) return false;
    }
    // Linear regression: each trial changes the residuals, and the regression finds the linear
    // combination of these changes that best cancels the residuals. Because the plane is fitted
    // again in each trial, the changes exclude effects that the plane can absorb. All steps are in
    // units of Trial::step.
    Matrix3 normal{};
    Vec3 right{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const DotOffset now = dot_offset(dots, k, plane, fit.displacement);
        if (!(now.squared() <= limit_of(fit))) continue;
        std::array<FloatVec, 3> changes;
        for (std::size_t i = 0; i < 3; ++i) {
            const FloatVec there = residual_in(trials[i], turn, k, dots);
            changes[i] = {there.x - now.residual.x, there.y - now.residual.y};
        }
        for (std::size_t i = 0; i < 3; ++i) {
            right[i] -= changes[i].x * now.residual.x + changes[i].y * now.residual.y;
            for (std::size_t j = 0; j < 3; ++j)
                normal[i][j] += changes[i].x * changes[j].x + changes[i].y * changes[j].y;
        }
    }
    // The drift computed from the plane is an additional observation.
    const FloatVec expected = drift_of(plane);
    const float in_deviations = tuned::kDriftStep / deviation_of_drift(plane, reach);
    const float weight = fit.variance * in_deviations * in_deviations;
    normal[1][1] += weight;
    normal[2][2] += weight;
    right[1] += weight * (expected.x - turn.drift.x) / tuned::kDriftStep;
    right[2] += weight * (expected.y - turn.drift.y) / tuned::kDriftStep;
    if (!invert(normal)) return false;
    Vec3 steps{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            steps[i] += normal[i][j] * right[j];
    }
    result.turn = turn;
    result.turn.rad_per_row += steps[0] * turn_step;
    result.turn.drift.x += steps[1] * tuned::kDriftStep;
    result.turn.drift.y += steps[2] * tuned::kDriftStep;
    transfer(turn, result.turn, dots);
    std::array<Vec3, 3> poses;
    for (std::size_t i = 0; i < 3; ++i)
        poses[i] = change_of_pose(plane, trials[i].plane, reference_px);
    if (!fit_plane(kernels, dots, fit.reach_px, limit_of(fit), fit.displacement, plane, fit))
        return false;
    result.variance = fit.variance * normal[0][0] * turn_step * turn_step;
    result.pose_covariance = {};
    for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = 0; b < 3; ++b) {
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 3; ++j)
                    result.pose_covariance[a][b] +=
                        fit.variance * poses[i][a] * normal[i][j] * poses[j][b];
            }
        }
    }
    return true;
}

}  // namespace dotpose::core

// Least squares of a PlaneFromImage, with perspective and lens, in integers of 64 bits.
#pragma once

#include <array>

#include "core/fit/affine_fit_int64.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core {

/// Which terms of a plane are fitted; each includes those before it.
enum class Terms : std::uint8_t { affine, perspective, lens };

constexpr std::size_t parameters(Terms terms) {
    return terms == Terms::affine ? 6U : terms == Terms::perspective ? 8U : 9U;
}

/// Multiplied out, the equation of PlaneFromImage is linear in its parameters, if `target` is
/// counted from where the centre is believed to be (so that `at`, what is left, is small):
///
///     target = at + du x + dv y - perspective.x (x target) - perspective.y (y target) - lens (r^2
///     target).
///
/// Two passes over the points: `add` each, then `reduce`, then `add_residual` each, then `solve`.
class PlaneFitInt64 {
  public:
    /// `estimate` gives the centre, and where about it lies. Image points are within `reach_px` of
    /// it.
    PlaneFitInt64(const PlaneFromImage& estimate, int reach_px, Terms terms);

    /// `target_q16` are the plane coordinates of the point, within 256 spacings of the centre's.
    void add(Vec image_point_q8, Vec target_q16);
    int count() const { return fits_[0].count(); }
    /// False where the points do not determine an affine map.
    bool reduce();
    void add_residual(Vec image_point_q8, Vec target_q16);
    /// False where they do not determine the further terms.
    bool solve(PlaneFromImage& plane) const;

  private:
    static constexpr std::size_t kExtra = 3;
    std::size_t extra() const { return parameters(terms_) - parameters(Terms::affine); }
    /// The target, and the target times x, y and r^2 in units of the reach.
    std::array<Vec, kExtra + 1> regressors(Vec from_centre_q8, Vec target_q16) const;

    Vec centre_q8_;
    Vec at_centre_q16_;
    int scale_ = 0;  ///< the reach is at most 2^scale_ px
    Terms terms_;
    std::array<AffineFitInt64, kExtra + 1> fits_;
    std::array<AffineMap, kExtra + 1> maps_;
    std::array<std::array<std::int64_t, kExtra>, kExtra> normal_{};
    std::array<std::int64_t, kExtra> right_{};
};

/// The plane a share, in 1/256, of the way from one to another with the same centre.
PlaneFromImage between(const PlaneFromImage& from, const PlaneFromImage& to, std::int64_t share_q8);

/// A fit with no more terms than are significant.
struct FittedPlane {
    PlaneFromImage plane;
    Terms terms = Terms::affine;
    int points = 0;
    std::int64_t squared_residuals = 0;  ///< sum over points and axes, 2^-32 spacing^2
};

/// Fits the points that `visit(use)` shows by calling use(image_point_q8, target_q16), the same
/// ones each time. Terms are added as far as they explain more than chance would; the curvature of
/// a lens only where it is beyond doubt. False where the points do not even determine an affine
/// map.
template <typename Visit>
bool fit_significant_plane(const PlaneFromImage& estimate, Terms most, Visit visit,
                           FittedPlane& best) {
    int reach_px = 1;
    visit([&](Vec point_q8, Vec) {
        reach_px = std::max<std::int32_t>(
            reach_px, larger_component(point_q8 - estimate.centre_q8) / 256 + 1);
    });
    bool found = false;
    for (const Terms terms : {Terms::affine, Terms::perspective, Terms::lens}) {
        if (terms > most) break;
        PlaneFitInt64 fit(estimate, reach_px, terms);
        visit([&](Vec point_q8, Vec target) { fit.add(point_q8, target); });
        if (!fit.reduce()) break;
        visit([&](Vec point_q8, Vec target) { fit.add_residual(point_q8, target); });
        FittedPlane fitted{{}, terms, fit.count(), 0};
        if (!fit.solve(fitted.plane)) break;
        visit([&](Vec point_q8, Vec target) {
            fitted.squared_residuals += squared(plane_point_q16(fitted.plane, point_q8) - target);
        });
        if (found) {
            // In units of the mean square, chance gains 1 with each parameter. Terms are kept in
            // the share that is more than chance (James and Stein 1961).
            const int more = static_cast<int>(parameters(terms) - parameters(best.terms));
            const int freedom =
                std::max(2 * fitted.points - static_cast<int>(parameters(terms)), 1);
            const std::int64_t gain = best.squared_residuals - fitted.squared_residuals;
            const std::int64_t by_chance = more * fitted.squared_residuals / freedom;
            const int needed = terms == Terms::lens ? 6 : 1;
            if (gain <= needed * by_chance) continue;
            fitted.plane = between(best.plane, fitted.plane, 256 - by_chance * 256 / gain);
        }
        best = fitted;
        found = true;
    }
    return found;
}

}  // namespace dotpose::core

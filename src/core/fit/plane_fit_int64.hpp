// Least squares of a PlaneFromImage, with perspective and lens, in 64-bit integers.
#pragma once

#include <array>

#include "core/fit/affine_fit_int64.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core {

/// Terms of a plane that are fitted. Each value includes the terms before it.
enum class Terms : std::uint8_t { affine, perspective, lens };

/// Returns the number of parameters of a plane with these terms.
constexpr std::size_t parameters(Terms terms) {
    return terms == Terms::affine ? 6U : terms == Terms::perspective ? 8U : 9U;
}

/// Least squares of a PlaneFromImage. Multiplied out, the equation is linear in the parameters if
/// `target` is relative to the estimated centre, which makes `at` small:
///
///     target = at + du x + dv y - perspective.x (x target) - perspective.y (y target)
///              - lens (r^2 target)
///
/// Two passes over the points: `add` each, then `reduce`, then `add_residual` each, then `solve`.
class PlaneFitInt64 {
  public:
    /// `estimate` contains the centre and its approximate place in the plane. Image points must be
    /// within `reach_px` of the centre.
    PlaneFitInt64(const PlaneFromImage& estimate, int reach_px, Terms terms);

    /// Adds a point. `target_q16` is its place in the plane, within 256 spacings of the place of
    /// the centre.
    void add(FixedVec image_point_q8, FixedVec target_q16);
    int count() const { return fits_[0].count(); }
    /// Subtracts the affine part from all regressors. Returns false if the points do not determine
    /// an affine map.
    bool reduce();
    /// Adds a point again, for the equations of the terms beyond the affine map.
    void add_residual(FixedVec image_point_q8, FixedVec target_q16);
    /// Sets the plane. Returns false if the points do not determine the terms beyond the affine
    /// map.
    bool solve(PlaneFromImage& plane) const;

  private:
    static constexpr std::size_t kExtra = 3;
    std::size_t extra() const { return parameters(terms_) - parameters(Terms::affine); }
    /// Returns the target, and the target times x, y and r^2, with x, y and r in units of the
    /// reach.
    std::array<FixedVec, kExtra + 1> regressors(FixedVec from_centre_q8, FixedVec target_q16) const;

    FixedVec centre_q8_;
    FixedVec at_centre_q16_;
    int scale_ = 0;  ///< log2 of an upper bound of the reach, in px
    Terms terms_;
    std::array<AffineFitInt64, kExtra + 1> fits_;
    std::array<AffineMap, kExtra + 1> maps_;
    std::array<std::array<std::int64_t, kExtra>, kExtra> normal_{};
    std::array<std::int64_t, kExtra> right_{};
};

/// Returns the plane at `weight_q8` / 256 of the way from one plane to another. Both have the same
/// centre.
PlaneFromImage between(const PlaneFromImage& from, const PlaneFromImage& to,
                       std::int64_t weight_q8);

/// A fit with only those terms that are significant.
struct FittedPlane {
    PlaneFromImage plane;
    Terms terms = Terms::affine;
    int points = 0;
    std::int64_t squared_residuals = 0;  ///< sum over points and axes, in 2^-32 spacing^2
};

/// Fits a plane to points. `visit(use)` calls use(image_point_q8, target_q16) for each point, and
/// is called several times. A term is included if it explains more of the residuals than chance
/// does; the lens term must explain six times as much as chance. Returns false if the points do not
/// determine an affine map.
template <typename Visit>
bool fit_significant_plane(const PlaneFromImage& estimate, Terms max_terms, Visit visit,
                           FittedPlane& best) {
    int reach_px = 1;
    visit([&](FixedVec point_q8, FixedVec) {
        reach_px = std::max<std::int32_t>(
            reach_px, larger_component(point_q8 - estimate.centre_q8) / 256 + 1);
    });
    bool found = false;
    for (const Terms terms : {Terms::affine, Terms::perspective, Terms::lens}) {
        if (terms > max_terms) break;
        PlaneFitInt64 fit(estimate, reach_px, terms);
        visit([&](FixedVec point_q8, FixedVec target) { fit.add(point_q8, target); });
        if (!fit.reduce()) break;
        visit([&](FixedVec point_q8, FixedVec target) { fit.add_residual(point_q8, target); });
        FittedPlane fitted{{}, terms, fit.count(), 0};
        if (!fit.solve(fitted.plane)) break;
        visit([&](FixedVec point_q8, FixedVec target) {
            fitted.squared_residuals += squared(plane_point_q16(fitted.plane, point_q8) - target);
        });
        if (found) {
            // By chance, each parameter explains one mean square of the residuals. Keeps the
            // fraction of a term that exceeds chance (James and Stein 1961).
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

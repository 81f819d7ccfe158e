// Grid fit: fits the plane of a grid in rounds, to more and more dots around the origin (paper,
// section II-B.3). The fit includes perspective once it uses dots more than four spacings from the
// origin.
#pragma once

#include <algorithm>

#include "core/kernels/kernels.hpp"
#include "core/lattice/tuning.hpp"
#include "core/math/float_plane.hpp"

namespace dotpose::core {

/// The grid found in a patch, and how well it fits the dots.
struct PatchGrid {
    /// Maps image points to the grid. The points are relative to the origin of the dot coordinates.
    FloatPlane grid_from_image;
    /// Root mean square displacement of the dots, in spacings. It is clamped to the range from
    /// kMinDisplacement to kMaxDisplacement (lattice/tuning.hpp).
    float displacement = 0;
    /// Mean squared offset between a dot and the nearest of the four dot positions of its cell,
    /// along each axis, in spacings^2.
    float variance = 0;
    /// Agreement of the dots with the grid, in spacings^2. Used to compare grids that were fitted
    /// to the same dots. If m is `CellPass::max_off`, each dot at a distance d <= m from the
    /// nearest dot position of its cell contributes m^2 - d^2.
    float agreement = 0;
};

/// Fits the plane of a grid to the dots around the origin, in rounds. Each round assigns the dots
/// to cells by the plane of the previous round.
class GridFit {
  public:
    /// `full_reach_px` is an upper bound on the distance of a dot from the origin, along each axis.
    GridFit(const Kernels& kernels, const PatchDots& dots, const FloatPlane& first_plane,
            float full_reach_px)
        : kernels_(kernels),
          dots_(dots),
          plane_(first_plane),
          first_spacing_px_(spacing_px(first_plane)),
          full_reach_px_(full_reach_px),
          reach_px_(tuning::outwards::kFirstReach * first_spacing_px_) {}

    /// Fits the plane to the dots nearest the origin, and estimates the displacement of the dots.
    /// Returns false if there are too few dots, or if they are not displaced.
    bool start();

    /// Increases the reach of the fit until it is good and covers the whole patch, or settles.
    /// Returns false if too few dots are near a dot position, or if a plane is not plausible.
    ///
    /// A fit may settle at a false plane that assigns outer dots to false dot positions. If a fit
    /// settles before it is good, it is continued once from a plane that is fitted to
    /// intersections. Without this step, 34 of the 4,000 planes in the test of small views are
    /// false.
    bool grow();

    /// Returns true if the fit covers enough of the patch for reading bits. Graphics may prevent
    /// the fit from covering the whole patch, so a fit to the dots within five spacings of the
    /// origin suffices.
    bool is_sufficient() const {
        return reach_px_ >= std::min(full_reach_px_, 5 * first_spacing_px_) && fraction() >= 0.5F;
    }

    PatchGrid grid() const {
        return {plane_, displacement_, variance(),
                sums_.used * max_off_ * max_off_ - sums_.squares};
    }

  private:
    /// Fits the plane as if all dots were on their intersections, so displacements act as noise.
    bool fit_to_intersections();
    /// Assigns each dot to the nearest of the four dot positions of its cell, so displacements do
    /// not act as noise.
    bool fit_to_places();
    bool fit(const CellPass& pass);
    bool needs_perspective() const { return reach_px_ > 4 * first_spacing_px_; }

    bool is_good() const;
    /// Returns true if the spacing is near the first spacing, and the perspective divisor differs
    /// from 1 by less than kMaxFold wherever |x| and |y| are at most the full reach.
    bool is_plausible() const;
    /// Fraction of the dots within the reach that are near a dot position.
    float fraction() const { return sums_.used / std::max(sums_.seen, 1.0F); }
    /// Variance of the distances from the used dots to their dot positions, per axis, in
    /// spacings^2.
    float variance() const { return sums_.squares / (2 * sums_.used); }

    const Kernels& kernels_;
    const PatchDots& dots_;
    FloatPlane plane_;
    float first_spacing_px_;
    float full_reach_px_;
    float reach_px_;          ///< maximum distance from the origin to a dot, along each axis
    float displacement_ = 0;  ///< in spacings
    float max_off_ = 0;       ///< see `CellPass::max_off`
    CellSums sums_;           ///< sums of the last round
};

}  // namespace dotpose::core

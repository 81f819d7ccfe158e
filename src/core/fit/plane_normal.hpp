// Plane normal: the normal equations for a plane with perspective, shear and lens distortion.
#pragma once

#include "core/fit/normal_equations.hpp"
#include "core/fit/projections.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Residuals of four points, in spacings, and their weights. Points with weight 0 are ignored.
struct Residuals {
    FourVecs offset;
    Four weight;
};

/// Weighted sums over points and their residuals. PlaneNormal computes the normal equations from
/// these sums.
class PlaneSums {
  public:
    void add(const FourVecs& places, const Residuals& residuals);
    FitSums all() const;

  private:
    /// Negated number of points with a positive weight. It is negative because a vector comparison
    /// yields -1 for true.
    FourInts less_points_{};
    std::array<Four, 4> places_{};
    /// Sums for `FitSums::residuals`, followed by the sum of squared residuals.
    std::array<Four, 3> residuals_{};
};

/// The normal equations for the parameters of `jacobian`.
class PlaneNormal : public NormalEquations<kPoseParameters> {
  public:
    PlaneNormal() = default;
    explicit PlaneNormal(const FitSums& sums);

    /// Decomposes the matrix. Returns false if the points do not determine position, scale and
    /// rotation. Excludes any other parameter that the points do not determine.
    bool decompose() {
        constexpr float kDetermined = 1e-4F;
        return NormalEquations::decompose(kDetermined, kTilt);
    }
    float squared_residuals() const { return squared_residuals_; }
    int points() const { return points_; }

  private:
    float squared_residuals_ = 0;
    int points_ = 0;
};

}  // namespace dotpose::core

// Least squares of a plane with perspective, shear and lens, in single precision: the normal
// equations.
#pragma once

#include "core/fit/projections.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// By how much four points lie off where they should, and what each counts: none with 0.
struct Residuals {
    FourVecs off;
    Four weight;
};

/// Sums over points, of which the normal equations consist.
class PlaneSumsFloat {
  public:
    void add(const Projections& projections, const Residuals& residuals);

  private:
    friend class PlaneNormalFloat;

    FourInts less_points_{};
    // Derivatives by scale and further terms, and residuals ...
    Four one_scale_square_{};  ///< 1; scale; the squared residual
    Four tilts_{};             ///< tilt_x, tilt_y
    Four bend_off_{};          ///< bend; the residual
    // ... times those by scale, turn and shear (2) ...
    Four scale_turned_{};
    Four tilt_x_turned_{};
    Four tilt_y_turned_{};
    Four bend_turned_{};
    Four off_turned_{};
    // ... and times each other.
    Four tilt_tilt_{};     ///< xx, yx, yy
    Four bend_further_{};  ///< tilt_x, tilt_y, bend
    Four off_further_{};   ///< tilt_x, tilt_y, bend
};

/// The normal equations, and their solution by Cholesky's decomposition.
class PlaneNormalFloat {
  public:
    PlaneNormalFloat() = default;
    explicit PlaneNormalFloat(const PlaneSumsFloat& sums);
    explicit PlaneNormalFloat(const FitSums& sums);

    /// The parameters that the points determine; the first four must be. Then L L^T is the matrix.
    bool decompose();

    /// L^-1 column: the inner product of two such is a . M^-1 . b.
    Parameters whitened(Parameters column) const;
    /// L^-T column.
    Parameters unwhitened(Parameters column) const;
    /// L^T column.
    Parameters times_transposed(const Parameters& column) const;

    /// An element of L.
    float factor(std::size_t row, std::size_t column) const { return m_[row][column]; }

    const Parameters& right() const { return right_; }
    float squared_residuals() const { return squared_residuals_; }
    int points() const { return points_; }
    bool determines(std::size_t parameter) const { return m_[parameter][parameter] > 0; }

  private:
    std::array<Parameters, kPoseParameters> m_{};  ///< the lower triangle
    Parameters right_{};
    float squared_residuals_ = 0;
    int points_ = 0;
};

}  // namespace dotpose::core

// Normal equations of the pose's least-squares fit, in single precision.
#pragma once

#include <array>
#include <cstddef>

#include "dotpose/workspace.hpp"

namespace dotpose::core {

/// Parameters of a plane, in the order in which they earn their place: at_centre (x, y); scale and
/// turn; perspective (x, y); shear (2); lens.
constexpr std::size_t kPoseParameters = 9;
constexpr std::size_t kTilt = 4;
constexpr std::size_t kShear = 6;
constexpr std::size_t kBend = 8;
using Parameters = std::array<float, kPoseParameters>;

/// A plane as the fit sees it: lengths in the image in units of `reach_px`, so that the
/// derivatives by all parameters are of like size and single precision suffices.
class ScaledPlane {
  public:
    ScaledPlane(const PlaneFromImage& plane, int reach_px);

    /// Where a pixel lies from `at_centre`, and the derivatives of that by the parameters.
    struct Sight {
        float x;
        float y;
        std::array<Parameters, 2> jacobian;
    };
    Sight look(Vec image_point_q8) const;

    /// Perspective, shear and lens: the parameters that a plain camera would not need; 0 for the
    /// others.
    Parameters distortions() const;
    /// Spacings per unit.
    float scale() const;
    /// The plane with its parameters changed.
    PlaneFromImage changed(const Parameters& by) const;

  private:
    PlaneFromImage plane_;
    float reach_px_;
    float du_x_, du_y_, dv_x_, dv_y_;  ///< spacings per unit
    float tilt_x_, tilt_y_, bend_;     ///< per unit, per unit^2
};

/// Sums of the normal equations, and their solution by Cholesky's decomposition.
class Normal {
  public:
    void add(const std::array<Parameters, 2>& jacobian, float residual_x, float residual_y,
             float weight = 1);

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
    std::array<Parameters, kPoseParameters> m_{};
    Parameters right_{};
    float squared_residuals_ = 0;
    int points_ = 0;
};

}  // namespace dotpose::core

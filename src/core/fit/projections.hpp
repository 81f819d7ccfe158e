// Projections: image points as the fit of the pose sees them through a plane, four at once.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/vectors.hpp"
#include "core/stages.hpp"

namespace dotpose::core {

/// Parameters of a plane, in the order in which they earn their place: at_centre (x, y); scale and
/// turn; perspective (x, y); shear (2); lens.
constexpr std::size_t kPoseParameters = 9;
constexpr std::size_t kTilt = 4;
constexpr std::size_t kShear = 6;
constexpr std::size_t kBend = 8;
using Parameters = std::array<float, kPoseParameters>;

/// Of four points, along both axes.
struct FourVecs {
    Four x;
    Four y;
};

/// Where four points lie, and the derivatives of that by the parameters. Those by at_centre are
/// (1, 0) and (0, 1); turn and shear have that of scale, turned and mirrored.
struct Projections {
    FourVecs at;  ///< from `at_centre`
    FourVecs scale;
    FourVecs tilt_x;
    FourVecs tilt_y;
    FourVecs bend;

    /// The derivatives of x and of y.
    std::array<Parameters, 2> jacobian(std::size_t point) const {
        const float u = scale.x[point];
        const float v = scale.y[point];
        return {Parameters{1, 0, u, -v, tilt_x.x[point], tilt_y.x[point], u, v, bend.x[point]},
                Parameters{0, 1, v, u, tilt_x.y[point], tilt_y.y[point], -v, u, bend.y[point]}};
    }
};

/// A plane as the fit sees it: lengths in the image in units of `reach_px`, so that the
/// derivatives by all parameters are of like size and single precision suffices.
class ScaledPlane {
  public:
    ScaledPlane(const PlaneFromImage& plane, int reach_px);

    /// Points in the image, counted from the plane's centre.
    Projections project(FourInts x_q8, FourInts y_q8) const;

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

}  // namespace dotpose::core

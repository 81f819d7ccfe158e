// Projections: image points as the fit of the pose sees them through a plane, four at once.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/vectors.hpp"
#include "core/stages.hpp"

namespace dotpose::core {

/// Parameters of a plane, those that matter most first: at_centre (x, y), scale, turn, perspective
/// (x, y), shear (2), lens. kTilt, kShear and kBend are the first of perspective, shear and lens.
constexpr std::size_t kPoseParameters = 9;
constexpr std::size_t kTilt = 4;
constexpr std::size_t kShear = 6;
constexpr std::size_t kBend = 8;
using Parameters = std::array<float, kPoseParameters>;

/// Coordinates of four points, or their derivatives.
struct FourVecs {
    Four x;
    Four y;
};

/// Where a plane has four points, in spacings, and the derivatives of that by the parameters. Those
/// by at_centre are (1, 0) and (0, 1); those by turn and shear are that by scale, turned and
/// mirrored.
struct Projections {
    FourVecs at;  ///< counted from `at_centre`
    FourVecs scale;
    FourVecs tilt_x;
    FourVecs tilt_y;
    FourVecs bend;

    /// Returns the derivatives of x and of y by all parameters, for one of the four points.
    std::array<Parameters, 2> jacobian(std::size_t point) const {
        const float u = scale.x[point];
        const float v = scale.y[point];
        return {Parameters{1, 0, u, -v, tilt_x.x[point], tilt_y.x[point], u, v, bend.x[point]},
                Parameters{0, 1, v, u, tilt_x.y[point], tilt_y.y[point], -v, u, bend.y[point]}};
    }
};

/// A plane as the fit sees it: lengths in the image are in units of `reach_px`, so that the
/// derivatives by all parameters are of like size and single precision suffices.
class ScaledPlane {
  public:
    ScaledPlane(const PlaneFromImage& plane, int reach_px);

    /// Projects four points of the image, in 1/256 px from the plane's centre, onto the plane.
    Projections project(FourInts x_q8, FourInts y_q8) const;

    /// Returns perspective, shear and lens, which a camera that looks straight at the sheet would
    /// not need; the other parameters are 0.
    Parameters distortions() const;
    /// Returns the scale in spacings per unit of length.
    float scale() const;
    /// Returns the plane with `by` added to its parameters.
    PlaneFromImage changed(const Parameters& by) const;

  private:
    PlaneFromImage plane_;
    float reach_px_;
    float du_x_, du_y_, dv_x_, dv_y_;  ///< spacings per unit of length
    float tilt_x_, tilt_y_, bend_;     ///< per unit; bend_ per unit^2
};

}  // namespace dotpose::core

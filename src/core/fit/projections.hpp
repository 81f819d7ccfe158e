// Projections: maps four image points through a plane, and computes the derivatives of this map
// with respect to the parameters of the plane.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/float_plane.hpp"
#include "core/math/vectors.hpp"

namespace dotpose::core {

/// Parameters of a plane, in order of decreasing importance: at_centre (x, y), scale, rotation,
/// perspective (x, y), shear (two parameters), lens distortion. The value of each parameter is its
/// effect, in spacings, at a place one unit from the origin. kTilt, kShear and kBend are the
/// indices of the first parameter of perspective, shear and lens distortion.
constexpr std::size_t kPoseParameters = 9;
constexpr std::size_t kTilt = 4;
constexpr std::size_t kShear = 6;
constexpr std::size_t kBend = 8;
using Parameters = std::array<float, kPoseParameters>;

/// Coordinates of four points.
struct FourVecs {
    Four x;
    Four y;
};

/// Returns the derivatives of x and of y with respect to all parameters, at one of four places. In
/// pattern coordinates, the derivatives are polynomials in the place (u, v): u (u, v) and v (u, v)
/// for perspective, and (u^2 + v^2) (u, v) for lens distortion.
std::array<Parameters, 2> jacobian(const FourVecs& places, std::size_t point);

/// A plane with parameters that act on the pattern instead of the image. Changes of scale,
/// rotation, perspective and shear are exact at any tilt. Places on the pattern are relative to the
/// plane's `at`, in units of its scale. With this unit, the derivatives with respect to all
/// parameters have similar magnitudes, so single precision is sufficient.
class ScaledPlane {
  public:
    ScaledPlane(const FloatPlane& plane, float reach_px);

    /// Returns the places on the pattern of four image points, given in px relative to the plane's
    /// centre.
    FourVecs project(Four x_px, Four y_px) const;

    /// Returns the parameters of perspective, shear and lens distortion, which are 0 for a camera
    /// without distortion that looks straight at the sheet. The other parameters in the result are
    /// 0.
    Parameters distortions() const;
    /// Returns the unit of places, in spacings: the length on the pattern that corresponds to
    /// `reach_px`.
    float scale() const { return scale_; }
    /// Returns the plane with `by` added to its parameters.
    FloatPlane changed(const Parameters& by) const;

  private:
    FloatPlane plane_;
    float reach_px_;
    float scale_;
};

}  // namespace dotpose::core

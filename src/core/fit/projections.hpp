// Projections: maps image points through a plane, four at a time, and computes the derivatives with
// respect to the plane parameters.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/float_plane.hpp"
#include "core/math/vectors.hpp"

namespace dotpose::core {

/// Plane parameters in order of decreasing importance: at_centre (x, y), scale, rotation,
/// perspective (x, y), shear (two parameters), lens distortion. The value of a parameter is the
/// shift that it causes, in spacings, at a distance of ScaledPlane::scale() from the plane centre.
/// kTilt, kShear and kBend are the first indices of perspective, shear and lens distortion.
constexpr std::size_t kPoseParameters = 9;
constexpr std::size_t kTilt = 4;
constexpr std::size_t kShear = 6;
constexpr std::size_t kBend = 8;
using Parameters = std::array<float, kPoseParameters>;

struct FourVecs {
    Four x;
    Four y;
};

/// Returns the derivatives of the pattern coordinates x and y with respect to all parameters, at
/// the scaled point with index `point` in `places` (see ScaledPlane). Each derivative is a
/// polynomial in the coordinates (u, v) of this point. For example, the derivatives of (x, y) with
/// respect to the perspective parameters are u (u, v) and v (u, v), and the derivative with respect
/// to lens distortion is (u^2 + v^2) (u, v).
std::array<Parameters, 2> jacobian(const FourVecs& places, std::size_t point);

/// A plane whose parameters transform pattern coordinates, not image coordinates. Changes in scale,
/// rotation, perspective and shear are therefore exact at any tilt. A *scaled point* is a pattern
/// point relative to the plane's `at`, in units of `scale()`. In these units, all derivatives have
/// similar magnitudes, so single precision is sufficient.
class ScaledPlane {
  public:
    ScaledPlane(const FloatPlane& plane, float reach_px);

    /// Maps four image points to scaled points. The image points are in px relative to the plane
    /// centre.
    FourVecs project(Four x_px, Four y_px) const;

    /// Returns the values of the perspective, shear and lens distortion parameters, and 0 for all
    /// other parameters. For a camera without distortion that looks straight at the sheet, all
    /// elements of the result are 0.
    Parameters distortions() const;
    /// Returns the unit of scaled points, in spacings: the pattern length that corresponds to
    /// `reach_px`.
    float scale() const { return scale_; }
    /// Returns the plane after adding `by` to its parameters.
    FloatPlane changed(const Parameters& by) const;

  private:
    FloatPlane plane_;
    float reach_px_;
    float scale_;
};

}  // namespace dotpose::core

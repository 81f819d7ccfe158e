// Projections: image points as the fit of the pose sees them through a plane, four at once.
#pragma once

#include <array>
#include <cstddef>

#include "core/math/float_plane.hpp"
#include "core/math/vectors.hpp"

namespace dotpose::core {

/// Parameters of a plane, those that matter most first: at_centre (x, y), scale, turn, perspective
/// (x, y), shear (2), lens. All are in spacings, at a place one unit away. kTilt, kShear and kBend
/// are the first of perspective, shear and lens.
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

/// Returns the derivatives of x and of y by all parameters, at one of four places. Seen from the
/// pattern, they are polynomials of the place: those of tilt and bend are (place . (1, 0)) place,
/// (place . (0, 1)) place and (place . place) place.
std::array<Parameters, 2> jacobian(const FourVecs& places, std::size_t point);

/// A plane as the fit sees it. Its parameters change the pattern, not the image: with scale, turn,
/// perspective and shear that is exact, however much the plane is tilted. Places on the pattern are
/// counted from the plane's `at`, in units of its scale, so that the derivatives by all parameters
/// are of like size and single precision suffices.
class ScaledPlane {
  public:
    ScaledPlane(const FloatPlane& plane, float reach_px);

    /// Returns the places of four points of the image, in px from the plane's centre.
    FourVecs project(Four x_px, Four y_px) const;

    /// Returns perspective, shear and lens, which a camera that looks straight at the sheet would
    /// not need; the other parameters are 0.
    Parameters distortions() const;
    /// Returns the unit of places, in spacings: how far `reach_px` reaches.
    float scale() const { return scale_; }
    /// Returns the plane with `by` added to its parameters.
    FloatPlane changed(const Parameters& by) const;

  private:
    FloatPlane plane_;
    float reach_px_;
    float scale_;
};

}  // namespace dotpose::core

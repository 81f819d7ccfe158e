// Sides: the planes of the two parts of a sheet that a line divides.
#pragma once

#include "core/pose/slip.hpp"

namespace dotpose::core {

/// While an object of this class lives, fits see only the dots on one side of a line: the cells of
/// all others are moved far away.
class OneSide {
  public:
    enum class Side : std::uint8_t { here, beyond };

    OneSide(Side side, MeasuredDots& dots, const FloatPlane& plane, FloatVec reference_px,
            const Slip& slip);
    OneSide(const OneSide&) = delete;
    OneSide& operator=(const OneSide&) = delete;
    ~OneSide();

  private:
    static constexpr float kFar = 1 << 20;
    MeasuredDots& dots_;
};

/// The likeliest line, and the plane on the reference point's side of it.
struct Sides {
    FloatPlane plane;
    PoseFit fit;
    Slip slip = {};
};

/// Sets the likeliest line and the fit to the dots on the reference point's side. `sides` comes
/// with the fit to all dots. Returns false if no line is likely enough.
bool fit_this_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px, Sides& sides);

/// Fits the plane beyond the line. Returns false if the dots there do not determine it.
bool fit_far_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                  const Sides& sides, FloatPlane& beyond);

}  // namespace dotpose::core

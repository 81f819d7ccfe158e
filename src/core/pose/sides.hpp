// Sides: the planes of the two parts of a sheet that a line divides.
#pragma once

#include "core/pose/slip.hpp"

namespace dotpose::core {

/// As long as it lives, fits see the dots on one side of a line only: the cells of the others are
/// taken for some far away.
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

/// From the plane that was fitted to all dots. False if no line is worth a thought.
bool fit_this_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px, Sides& sides);

/// The plane beyond the line. False if the dots there do not determine it.
bool fit_far_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                  const Sides& sides, FloatPlane& beyond);

}  // namespace dotpose::core

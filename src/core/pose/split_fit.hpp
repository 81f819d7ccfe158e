// Split fit: fits one plane to each of the two parts of a sheet that a line divides.
#pragma once

#include "core/pose/paper_step.hpp"

namespace dotpose::core {

/// Hides the dots on one side of a line from fits during the lifetime of the object, by moving the
/// cells of these dots far away.
class HalfPlane {
  public:
    enum class Side : std::uint8_t { here, beyond };

    HalfPlane(Side side, MeasuredDots& dots, const FloatPlane& plane, FloatVec reference_px,
              const PaperStep& step);
    HalfPlane(const HalfPlane&) = delete;
    HalfPlane& operator=(const HalfPlane&) = delete;
    ~HalfPlane();

  private:
    static constexpr float kFar = 1 << 20;
    MeasuredDots& dots_;
};

/// The likeliest line, and the plane on the side of the reference point.
struct SplitFit {
    FloatPlane plane;
    PoseFit fit;
    PaperStep step = {};
};

/// Finds the likeliest line and fits the plane to the dots on the side of the reference point. On
/// entry, `split` contains the fit to all dots. Returns false if no line is likely enough.
bool fit_this_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   SplitFit& split);

/// Fits the plane beyond the line. Returns false if the dots beyond the line do not determine it.
bool fit_far_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                  const SplitFit& split, FloatPlane& beyond);

}  // namespace dotpose::core

// Split fit: fits a plane to each side of a line that divides a sheet.
#pragma once

#include "core/pose/paper_step.hpp"

namespace dotpose::core {

/// Restricts fits to one side of a line during the lifetime of the object. The constructor moves
/// the cells of all other dots far away, to make these dots outliers. The destructor moves the
/// cells back. Dots near the line belong to neither side.
class HalfPlane {
  public:
    /// The side to fit: the side of the reference point, or the side beyond the line.
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

/// Result of a split fit: the most likely dividing line, and the plane fitted to the side of the
/// reference point.
struct SplitFit {
    FloatPlane plane;
    PoseFit fit;
    PaperStep step = {};
};

/// Finds the most likely dividing line, and fits the plane to the side of the reference point. On
/// entry, `split` contains the fit to all dots. Returns false if no line has a gain of at least
/// PaperStep::kPossible, or if the dots on this side do not determine a plane. In these cases,
/// `split` must not be used.
bool fit_this_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   SplitFit& split);

/// Fits a plane to the dots beyond the line. Returns false if too few of these dots share a common
/// residual relative to the plane of this side, or if the dots do not determine a plane.
bool fit_far_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                  const SplitFit& split, FloatPlane& beyond);

}  // namespace dotpose::core

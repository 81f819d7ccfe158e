/// Print model: the displacement of printed ink from its intended position.
#pragma once

#include "dotpose/export.hpp"
#include "dotpose/tools/simulate.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Model of the printing errors over a page: a smooth, low-frequency shift of the ink. The shape of
/// the shift is an assumption and was not measured. By default, the maximum errors in an area of
/// kSide_mm x kSide_mm are those of Table III of the paper, rounded down to 0.01 mm: 0.15 mm along
/// x, and 0.27 mm along y, which is the direction of paper feed.
class PrintModel {
  public:
    /// Side of the square area to which the maximum errors apply.
    static constexpr double kSide_mm = 200;

    /// `worst_x_mm` and `worst_y_mm` are the maximum errors along x and y, over the positions that
    /// `run_protocol` uses.
    PrintModel(double worst_x_mm = 0.15, double worst_y_mm = 0.27);

    /// Returns the printed minus the intended position, for a point given relative to the middle of
    /// the area.
    Vec2 shift_mm(Vec2 from_middle_mm) const;

  private:
    Vec2 amplitude_mm_{1, 1};
};

}  // namespace dotpose

DOTPOSE_END_EXPORT

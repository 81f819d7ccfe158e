/// Computes the image of a dot from its geometry, and renders frames from these dot images. This
/// renderer shares no code with the simulator (`render`) or the core, so it can reveal errors in
/// the simulator.
#pragma once

#include <vector>

#include "dotpose/tools/simulate.hpp"

namespace dotpose::tables {

/// A disk of ink, convolved with the motion during the exposure, a Gaussian blur, and the area of a
/// pixel. The darkness is 0 for paper and 1 for a pixel that is completely covered with ink.
class DotImage {
  public:
    DotImage(double radius_px, double blur_px, Vec2 motion_px);

    /// Returns the darkness of a pixel. `from_dot` is the pixel centre relative to the dot centre.
    double darkness(Vec2 from_dot) const;
    /// Returns the derivative of `darkness` with respect to a shift of the dot.
    Vec2 derivative(Vec2 from_dot) const;

  private:
    /// Returns the fraction of a point's light that a pixel receives, along one axis. The total
    /// fraction is the product over both axes. `distance_px` is the distance between the point and
    /// the pixel centre along this axis.
    double fraction(double distance_px) const;
    double derivative_of_fraction(double distance_px) const;

    std::vector<Vec2> points_;  ///< points of equal weight that represent the disk and its motion
    double weight_;
    double blur_px_;
};

/// A lookup table of the darkness of a dot. Interpolates `DotImage::darkness` on a fine grid. The
/// darkness is 0 for pixels that are more than kReach_px away along either axis.
class DotTable {
  public:
    explicit DotTable(const DotImage& dot);

    static constexpr int kReach_px = 6;
    double darkness(Vec2 from_dot) const;

  private:
    static constexpr int kSteps = 16;  ///< grid steps per px
    static constexpr int kSide = 2 * (kReach_px + 1) * kSteps + 1;

    double at(int i, int j) const { return values_[static_cast<std::size_t>(kSide * j + i)]; }

    std::vector<double> values_;
};

/// Renders the frame of a shot. The blur, motion and size of the dots are taken from `dot`. The
/// tilt of the pose is ignored, as are all imperfections except the levels of paper and ink, the
/// illumination gradient and the noise.
GreyImage draw_with(const DotTable& dot, const Shot& shot);

}  // namespace dotpose::tables

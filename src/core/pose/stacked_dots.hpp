// Stacked dots: summed dot images, grouped by sub-pixel phase.
#pragma once

#include <array>
#include <cstdlib>

#include "core/math/plane_units.hpp"
#include "core/pose/dot_model.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Pixel and sub-pixel phase of an image point.
struct Phase {
    int u = 0;  ///< pixel that contains the point
    int v = 0;
    FloatVec rest;  ///< offset from the pixel centre, in [-0.5, 0.5] px

    explicit Phase(FloatVec point_px)
        : u(static_cast<int>(nearest_whole(point_px.x))),
          v(static_cast<int>(nearest_whole(point_px.y))),
          rest{point_px.x - static_cast<float>(u), point_px.y - static_cast<float>(v)} {}
};

/// Sums of dot images, grouped by the sub-pixel phase of the dot centres. A pixel is divided into 4
/// x 4 squares, and all dots whose centres are in the same square form one stack.
class StackedDots {
  public:
    struct Stack {
        float dots = 0;
        FloatVec rest;      ///< sum of `Phase::rest` over the dots in the stack
        float squares = 0;  ///< summed squared darkness of all used pixels
        /// Summed darkness, as a fraction of the paper level around each dot.
        DotPixels darkness;
    };

    /// Uses the pixels within `reach_px` of the central pixel, and within kHalf_px along each axis.
    explicit StackedDots(float reach_px);

    /// Adds a dot if all its pixels are in the image. `paper` is the paper level around the dot.
    void add(const ImageView& image, const Phase& phase, float paper);

    /// Keeps the stacks with the most dots, until they contain at least `enough_dots` dots or their
    /// number is `max_count`. Removes the other stacks.
    void keep_fullest(std::size_t max_count, float enough_dots);

    /// Calls `use` for each stack that contains dots.
    template <typename Use>
    void visit(Use use) const {
        for (const Stack& stack : stacks_) {
            if (stack.dots > 0) use(stack);
        }
    }
    /// Calls `use(u, v)` for each used pixel. `u` and `v` are relative to the central pixel.
    template <typename Use>
    void visit_pixels(Use use) const {
        for (int v = -half_px_; v <= half_px_; ++v) {
            const int width_px = widths_px_[static_cast<std::size_t>(std::abs(v))];
            for (int u = -width_px; u <= width_px; ++u)
                use(u, v);
        }
    }
    /// Returns the distance from the central pixel to the outermost pixels along each axis, in px.
    int half_px() const { return half_px_; }
    float dots() const;
    /// Returns true if there are enough dots to estimate the noise from differences between dots in
    /// the same stack.
    bool are_enough() const;
    /// Returns the total darkness of a dot, averaged over all dots. Requires `are_enough`.
    float mass() const;
    /// Returns the mean squared distance of the darkness of a dot from its centre, along one axis,
    /// in px^2. Requires that `mass` is not 0.
    float spread_px2() const;
    /// Returns the variance of a pixel's darkness within a stack, plus a constant for the
    /// quantization of grey levels. Requires `are_enough`.
    float noise_2() const;

  private:
    static constexpr int kAlong = 4;  ///< number of stacks along each axis

    std::array<Stack, kAlong * kAlong> stacks_{};
    int half_px_;
    /// Number of used pixels to the left and right of the central column, in the rows at each
    /// distance from the central row.
    std::array<int, DotPixels::kHalf_px + 1> widths_px_{};
};

}  // namespace dotpose::core

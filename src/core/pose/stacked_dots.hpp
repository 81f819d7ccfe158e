// Stacked dots: mean images of dots by where they fall on the pixels.
#pragma once

#include "core/pose/dot_model.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Where a point of the image falls on the pixels.
struct Phase {
    int u = 0;  ///< the pixel that holds the point
    int v = 0;
    FloatVec rest;  ///< from the middle of that pixel, px

    explicit Phase(FloatVec point_px);
};

/// Images of dots, added up by the quarters of a pixel, along u and v, into which they fall.
class StackedDots {
  public:
    /// The dots of one stack.
    struct Stack {
        float dots = 0;
        FloatVec rest;       ///< sum of the parts of pixels, see Phase
        DotPixels darkness;  ///< sum of the darkness, relative to the paper around each dot
    };

    /// Pixels count within `reach_px` of the pixel in the middle.
    explicit StackedDots(float reach_px);

    /// Adds a dot, unless the image does not hold all of its pixels.
    void add(const ImageView& image, const Phase& phase, float paper);

    /// Shows each stack with dots.
    template <typename Use>
    void visit(Use use) const {
        for (const Stack& stack : stacks_) {
            if (stack.dots > 0) use(stack);
        }
    }
    /// Shows the pixels that count, from the one in the middle.
    template <typename Use>
    void visit_pixels(Use use) const {
        for (int v = -half_px_; v <= half_px_; ++v) {
            for (int u = -half_px_; u <= half_px_; ++u) {
                if (u * u + v * v <= reach_2_) use(u, v);
            }
        }
    }
    /// Returns how far from the one in the middle pixels count, along each axis.
    int half_px() const { return half_px_; }
    /// Whether there are enough dots to tell a typical one from noise.
    bool are_enough() const;
    /// Returns the mean darkness of a dot: the sum over its pixels.
    float mass() const;
    /// Returns the variance of a pixel among the dots of a stack.
    float noise_2() const;

  private:
    static constexpr int kAlong = 4;

    std::array<Stack, kAlong * kAlong> stacks_{};
    float squares_ = 0;  ///< of the darkness of all pixels that count
    float dots_ = 0;
    int half_px_;
    int reach_2_;
};

}  // namespace dotpose::core

#include "core/pose/stacked_dots.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::core {

Phase::Phase(FloatVec point_px)
    : u(static_cast<int>(std::floor(point_px.x + 0.5F))),
      v(static_cast<int>(std::floor(point_px.y + 0.5F))),
      rest{point_px.x - static_cast<float>(u), point_px.y - static_cast<float>(v)} {}

StackedDots::StackedDots(float reach_px)
    : half_px_(std::min(static_cast<int>(reach_px), DotPixels::kHalf_px)),
      reach_2_(static_cast<int>(std::min(reach_px * reach_px, 1000.0F))) {}

void StackedDots::add(const ImageView& image, const Phase& phase, float paper) {
    if (phase.u < half_px_ || phase.u >= image.width_px - half_px_ || phase.v < half_px_ ||
        phase.v >= image.height_px - half_px_) {
        return;
    }
    const auto part = [](float rest) {
        return std::clamp(static_cast<int>((rest + 0.5F) * kAlong), 0, kAlong - 1);
    };
    Stack& stack =
        stacks_[static_cast<std::size_t>(part(phase.rest.y) * kAlong + part(phase.rest.x))];
    stack.dots += 1;
    stack.rest.x += phase.rest.x;
    stack.rest.y += phase.rest.y;
    dots_ += 1;
    visit_pixels([&](int u, int v) {
        const float level = image.row(phase.v + v)[phase.u + u];
        const float darkness = 1 - level / paper;
        stack.darkness.at(u, v) += darkness;
        squares_ += darkness * darkness;
    });
}

bool StackedDots::are_enough() const {
    constexpr float kMinBeyond = 16;  // minimum number of dots, in addition to one per stack
    float stacks = 0;
    visit([&](const Stack&) { stacks += 1; });
    return dots_ >= stacks + kMinBeyond;
}

float StackedDots::mass() const {
    float sum = 0;
    visit([&](const Stack& stack) {
        visit_pixels([&](int u, int v) { sum += stack.darkness.at(u, v); });
    });
    return sum / dots_;
}

float StackedDots::noise_2() const {
    constexpr float kMinVariance = 1e-6F;  // variance due to the quantization of grey levels
    float between = 0;
    float freedom = 0;
    visit([&](const Stack& stack) {
        visit_pixels([&](int u, int v) {
            between += stack.darkness.at(u, v) * stack.darkness.at(u, v) / stack.dots;
            freedom += stack.dots - 1;
        });
    });
    return std::max((squares_ - between) / freedom, 0.0F) + kMinVariance;
}

}  // namespace dotpose::core

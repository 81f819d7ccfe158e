#include "core/pose/stacked_dots.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace dotpose::core {

StackedDots::StackedDots(float reach_px)
    : half_px_(std::min(static_cast<int>(reach_px), DotPixels::kHalf_px)) {
    for (int v = 0; v <= half_px_; ++v) {
        const float square = reach_px * reach_px - static_cast<float>(v * v);
        widths_px_[static_cast<std::size_t>(v)] =
            std::min(static_cast<int>(std::sqrt(square)), half_px_);
    }
}

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
    const float per_level = 1 / paper;
    float squares = 0;
    visit_pixels([&](int u, int v) {
        const float level = image.row(phase.v + v)[phase.u + u];
        const float darkness = 1 - level * per_level;
        stack.darkness.at(u, v) += darkness;
        squares += darkness * darkness;
    });
    stack.squares += squares;
}

void StackedDots::keep_fullest(std::size_t max_count, float enough_dots) {
    const auto has_more = [&](std::size_t a, std::size_t b) {
        return stacks_[a].dots != stacks_[b].dots ? stacks_[a].dots > stacks_[b].dots : a < b;
    };
    std::array<std::size_t, kAlong * kAlong> order;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), has_more);
    std::size_t kept = 0;
    for (float dots = 0; kept < max_count && dots < enough_dots; ++kept)
        dots += stacks_[order[kept]].dots;
    for (const std::size_t i : std::span(order).subspan(kept))
        stacks_[i].dots = 0;
}

float StackedDots::dots() const {
    float sum = 0;
    visit([&](const Stack& stack) { sum += stack.dots; });
    return sum;
}

bool StackedDots::are_enough() const {
    constexpr float kMinBeyond = 16;  // minimum number of dots, in addition to one per stack
    float stacks = 0;
    visit([&](const Stack&) { stacks += 1; });
    return dots() >= stacks + kMinBeyond;
}

float StackedDots::mass() const {
    float sum = 0;
    visit([&](const Stack& stack) {
        visit_pixels([&](int u, int v) { sum += stack.darkness.at(u, v); });
    });
    return sum / dots();
}

float StackedDots::spread_px2() const {
    float darkness = 0;
    float squares = 0;
    visit([&](const Stack& stack) {
        const FloatVec rest{stack.rest.x / stack.dots, stack.rest.y / stack.dots};
        visit_pixels([&](int u, int v) {
            const float x = static_cast<float>(u) - rest.x;
            const float y = static_cast<float>(v) - rest.y;
            darkness += stack.darkness.at(u, v);
            squares += stack.darkness.at(u, v) * (x * x + y * y);
        });
    });
    return squares / (2 * darkness);
}

float StackedDots::noise_2() const {
    constexpr float kMinVariance = 1e-6F;  // variance due to the quantization of grey levels
    float within = 0;
    float freedom = 0;
    visit([&](const Stack& stack) {
        within += stack.squares;
        visit_pixels([&](int u, int v) {
            within -= stack.darkness.at(u, v) * stack.darkness.at(u, v) / stack.dots;
            freedom += stack.dots - 1;
        });
    });
    return std::max(within / freedom, 0.0F) + kMinVariance;
}

}  // namespace dotpose::core

// Tests the dot model against dots drawn by sampling, and its derivatives against finite
// differences.
#include "core/pose/dot_model.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "drawn_dot.hpp"

namespace dotpose::core_test::dot_model_test {
namespace {

using core::DotImages;
using core::DotPixels;
using core::ModelDot;

template <typename Compare>
void for_each_pixel(Compare compare) {
    for (int v = -DotPixels::kHalf_px; v <= DotPixels::kHalf_px; ++v) {
        for (int u = -DotPixels::kHalf_px; u <= DotPixels::kHalf_px; ++u)
            compare(u, v);
    }
}

TEST(DotModel, IsABlurredEllipse) {
    for (const double radius : {0.6, 1.0, 2.1, 4.2}) {
        for (const double blur : {0.3, 0.7}) {
            SCOPED_TRACE(testing::Message() << "radius " << radius << ", blur " << blur);
            const Vec2 centre{0.23, -0.41};
            const double high = 0.9 * radius;
            const DrawnDot expected = drawn_dot(ellipse(radius, high), centre, blur);
            const double area = std::numbers::pi * radius * high;
            const core::FloatVec radius_2{static_cast<float>(radius * radius),
                                          static_cast<float>(high * high)};
            const auto blur_2 = static_cast<float>(blur * blur);
            const DotImages images =
                core::draw({{static_cast<float>(centre.x), static_cast<float>(centre.y)},
                            radius_2,
                            {blur_2, blur_2}},
                           6);
            for_each_pixel([&](int u, int v) {
                EXPECT_NEAR(area * double{images.dot.at(u, v)}, expected.at(u, v), 0.004)
                    << "pixel " << u << ", " << v;
            });
        }
    }
}

TEST(DotModel, HasAnObliqueBlur) {
    const Vec2 centre{0.23, -0.41};
    const Vec2 motion{1, 0.6};
    constexpr double kBlur_px = 0.7;
    const DrawnDot expected = moving_dot(disc(1), centre, kBlur_px, motion);
    // A uniform motion during the exposure adds motion^2 / 12 to the variance of the blur.
    const auto plus_motion = [](double blur_2, double by) {
        return static_cast<float>(blur_2 + by / 12);
    };
    const DotImages images =
        core::draw({{static_cast<float>(centre.x), static_cast<float>(centre.y)},
                    {1, 1},
                    {plus_motion(kBlur_px * kBlur_px, motion.x * motion.x),
                     plus_motion(kBlur_px * kBlur_px, motion.y * motion.y)},
                    plus_motion(0, motion.x * motion.y)},
                   6);
    for_each_pixel([&](int u, int v) {
        EXPECT_NEAR(std::numbers::pi * double{images.dot.at(u, v)}, expected.at(u, v), 0.003)
            << "pixel " << u << ", " << v;
    });
}

TEST(DotModel, KnowsItsDerivatives) {
    constexpr float kStep = 0.02F;
    const ModelDot dot{{0.15F, -0.3F}, {1.4F, 1.1F}, {0.16F, 0.3F}};
    const DotImages images = core::draw(dot, 6);
    for (std::size_t i = 0; i < images.derivatives.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "derivative " << i);
        const auto moved = [&](float by) {
            ModelDot other = dot;
            float* const terms[] = {&other.centre.x,   &other.centre.y, &other.radius_2.x,
                                    &other.radius_2.y, &other.blur_2.x, &other.blur_2.y,
                                    &other.blur_uv};
            *terms[i] += by;
            return core::draw(other, 6).dot;
        };
        const DotPixels more = moved(kStep);
        const DotPixels less = moved(-kStep);
        float largest = 0;
        for_each_pixel([&](int u, int v) {
            const float expected = (more.at(u, v) - less.at(u, v)) / (2 * kStep);
            largest = std::max(largest, std::abs(expected));
            EXPECT_NEAR(images.derivatives[i].at(u, v), expected, 0.003)
                << "pixel " << u << ", " << v;
        });
        EXPECT_GT(largest, 0.03F);
    }
}

}  // namespace
}  // namespace dotpose::core_test::dot_model_test

// Tests the measurement of the paper level on drawn images in which this level is known.
#include "core/detect/paper.hpp"

#include <array>

#include <gtest/gtest.h>

#include "../canvas.hpp"

namespace dotpose::core_test::paper_test {
namespace {

using namespace core;

struct Measured {
    explicit Measured(const GreyImage& image) {
        map.levels = levels;
        map.brightest = brightest;
        measure_paper(image.view(), map);
    }
    std::array<std::uint8_t, 400> levels{};
    std::array<std::uint8_t, 400> brightest{};
    PaperMap map;
};

TEST(Paper, FollowsTheLightUnderDotsAndStrokes) {
    GreyImage image = blank(188, 120);
    const auto light = [](int u) { return 80 + u / 2; };
    for (int v = 0; v < 120; ++v) {
        for (int u = 0; u < 188; ++u)
            pixel(image, u, v) = static_cast<std::uint8_t>(light(u));
    }
    for (int v = 5; v < 120; v += 11) {
        for (int u = 5; u < 188; u += 11)
            fill(image, u, v, u + 3, v + 3, 20);
    }
    fill(image, 0, 48, 188, 64, 10);
    const Measured measured(image);
    for (int v = 0; v < 120; v += 7) {
        for (int u = 0; u < 188; u += 7) {
            // The paper level of a block under the stroke is that of a neighbouring block, 12 px
            // away, where the light differs. The tolerance allows for this difference.
            EXPECT_NEAR(paper_at(measured.map, u, v), light(u), 14) << u << ", " << v;
            EXPECT_GE(brightest_paper_near(measured.map, u, v), paper_at(measured.map, u, v));
        }
    }
}

TEST(Paper, OfABlackImageIsNotZero) {
    GreyImage image = blank(64, 64);
    fill(image, 0, 0, 64, 64, 0);
    EXPECT_EQ(paper_at(Measured(image).map, 10, 10), 1);
}

}  // namespace
}  // namespace dotpose::core_test::paper_test

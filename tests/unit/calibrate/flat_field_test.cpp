// Tests flat fields computed from images with known lighting.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/calibrate.hpp"

namespace dotpose {
namespace {

using testing::HasSubstr;

constexpr int kColumns = 40;
constexpr int kRows = 30;
constexpr std::uint32_t kDotSeed = 5;

/// Returns the relative brightness of the paper at a pixel. It decreases by 40 % from the middle to
/// the corners, and by 10 % from left to right.
double light_at(double u, double v) {
    const double x = 2 * u / (kColumns - 1) - 1;
    const double y = 2 * v / (kRows - 1) - 1;
    return (1 - 0.2 * (x * x + y * y)) * (0.95 - 0.05 * x);
}

/// Returns an image of white paper, with the brightness given by `light_at`. A tenth of the pixels,
/// chosen at random, are dark.
GreyImage dots_at_random(int index) {
    std::mt19937 random(kDotSeed + static_cast<std::uint32_t>(index));
    GreyImage image{{}, kColumns, kRows};
    for (int v = 0; v < kRows; ++v) {
        for (int u = 0; u < kColumns; ++u) {
            const double level = random() % 10 == 0 ? 50 : 220;
            image.pixels.push_back(static_cast<std::uint8_t>(std::lround(level * light_at(u, v))));
        }
    }
    return image;
}

std::string refusal_of_field(int frames, const FrameAt& frame_at,
                             const std::optional<Camera>& camera) {
    try {
        calibrate_flat_field(frames, frame_at, camera, {});
    } catch (const Error& error) {
        return error.what();
    }
    return "not refused";
}

TEST(CalibrateFlatField, FindsTheLight) {
    const FlatFieldCalibration found = calibrate_flat_field(400, dots_at_random, {}, {});
    EXPECT_EQ(found.camera.width_px, kColumns);
    EXPECT_EQ(found.camera.height_px, kRows);
    EXPECT_EQ(found.camera.centre_px.u, 19.5);
    const auto& field = found.camera.flat_field;
    double brightest = 0;
    for (int u = 0; u < kColumns; ++u)
        brightest = std::max(brightest, light_at(u, (kRows - 1) / 2.0));
    for (std::size_t j = 0; j < field.size(); ++j) {
        for (std::size_t i = 0; i < field[j].size(); ++i) {
            const double u = static_cast<double>(i * (kColumns - 1)) / double(field[j].size() - 1);
            const double v = static_cast<double>(j * (kRows - 1)) / double(field.size() - 1);
            EXPECT_NEAR(field[j][i], light_at(u, v) / brightest, 0.03) << i << ", " << j;
        }
    }
    // A tenth of the pixels are dots, whose level is 23 % of the paper level. In one frame, the
    // standard deviation of a pixel is therefore 25 % of its mean. The standard deviation of the
    // mean of 400 frames is one twentieth of this value, 1.25 %.
    EXPECT_NEAR(found.residual, 0.0127, 0.004);
    validate(found.camera);
}

TEST(CalibrateFlatField, KeepsTheRestOfACamera) {
    Camera camera;
    camera.width_px = kColumns;
    camera.height_px = kRows;
    camera.centre_px = {20, 15};
    camera.gain = 3;
    const FlatFieldCalibration found = calibrate_flat_field(40, dots_at_random, camera, {});
    EXPECT_EQ(found.camera.centre_px.u, 20);
    EXPECT_EQ(found.camera.gain, 3);
    EXPECT_FALSE(found.camera.flat_field.empty());
}

TEST(CalibrateFlatField, RefusesFramesThatDoNotDetermineIt) {
    EXPECT_THAT(refusal_of_field(19, dots_at_random, {}), HasSubstr("at least 20 are needed"));
    EXPECT_THAT(refusal_of_field(40, [](int) { return dots_at_random(0); }, {}),
                HasSubstr("move the camera between frames"));
    Camera camera;
    camera.width_px = kColumns + 1;
    camera.height_px = kRows;
    EXPECT_THAT(refusal_of_field(40, dots_at_random, camera),
                HasSubstr("frame 1 has 40 x 30 px, not 41 x 30 px"));
    const auto dark = [](int) {
        GreyImage image{std::vector<std::uint8_t>(kColumns * kRows, 0), kColumns, kRows};
        for (int v = 0; v < kRows; ++v)
            image.pixels[static_cast<std::size_t>(v * kColumns)] = 200;
        return image;
    };
    EXPECT_THAT(refusal_of_field(40, dark, {}), HasSubstr("light the paper more evenly"));
}

}  // namespace
}  // namespace dotpose

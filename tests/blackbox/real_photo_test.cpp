// Tests `locate` with a real photo of a real print. The photo must not be published, so it is
// stored outside the project.
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "../paths.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose {
namespace {

namespace fs = std::filesystem;

// Expected values from an independent decoder, which fits a homography to 184 dots.
constexpr double kX_grid = 129.157;
constexpr double kY_grid = 3224.485;
constexpr double kTheta_deg = -1.45;
constexpr double kSpacing_px = 20.2;

/// Returns the image rotated by a quarter turn, pixel by pixel. The x axis of the result points
/// upwards in the original.
GreyImage turned(const GreyImage& image) {
    GreyImage result{image.pixels, image.height_px, image.width_px};
    for (int v = 0; v < result.height_px; ++v) {
        for (int u = 0; u < result.width_px; ++u) {
            const int old_u = v;
            const int old_v = image.height_px - 1 - u;
            result.pixels[static_cast<std::size_t>(v * result.width_px + u)] =
                image.pixels[static_cast<std::size_t>(old_v * image.width_px + old_u)];
        }
    }
    return result;
}

class RealPhoto : public testing::TestWithParam<int> {};

TEST_P(RealPhoto, is_located_whatever_way_it_is_turned) {
    const fs::path path = fs::path(test::source_dir()) / "../shared/real/photo.pgm";
    if (!fs::exists(path)) GTEST_SKIP() << "no real photo: " << path << " does not exist";
    GreyImage image = read_image(path);
    for (int i = 0; i < GetParam(); ++i)
        image = turned(image);

    const auto memory = std::make_unique<LargeMemory>();
    const Fix fix = Locator(*memory, DeviceOptions{}).locate(image.view());
    ASSERT_EQ(fix.status, Status::ok) << message(fix.status);
    EXPECT_NEAR(fix.x_grid(), kX_grid, 0.1);
    EXPECT_NEAR(fix.y_grid(), kY_grid, 0.1);
    EXPECT_NEAR(fix.spacing_px(), kSpacing_px, 0.3);
    const double theta_deg = fix.theta_rad() * 180 / std::numbers::pi;
    const double expected_deg = kTheta_deg - 90 * GetParam();
    EXPECT_NEAR(std::remainder(theta_deg - expected_deg, 360), 0, 0.5);
    // The expected section follows from the definition in code.hpp. No other section agrees with
    // the bits.
    EXPECT_EQ(fix.section, (Section{24, 32}));
    EXPECT_EQ(fix.bit_errors, 0);
}

INSTANTIATE_TEST_SUITE_P(QuarterTurns, RealPhoto, testing::Range(0, 4));

}  // namespace
}  // namespace dotpose

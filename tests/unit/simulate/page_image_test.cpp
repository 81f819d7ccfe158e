// Tests pages that are given as images. The frames must equal those of the same page given as a
// pattern.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "helpers.hpp"

namespace dotpose::simulate_test {
namespace {

constexpr double kPageWidth_mm = 14;
constexpr double kPageHeight_mm = 12;
/// Distance of the first intersection from the left and top edges of the page.
constexpr double kFirst_mm = 1.3;

/// Returns a page with discs of solid ink, painted with 4 x 4 samples per pixel. Does not use code
/// from src/simulate.
GreyImage painted(const Page& page, double mm_per_px) {
    GreyImage image;
    image.width_px = static_cast<int>(kPageWidth_mm / mm_per_px);
    image.height_px = static_cast<int>(kPageHeight_mm / mm_per_px);
    const Pattern& pattern = page.pattern;
    const double radius_mm = pattern.dot_mm / 2;
    const auto is_ink = [&](double x_mm, double y_mm) {
        const auto i = std::lround((x_mm - kFirst_mm) / pattern.spacing_mm);
        const auto j = std::lround((y_mm - kFirst_mm) / pattern.spacing_mm);
        if (i < 0 || j < 0 || i >= page.columns || j >= page.rows) return false;
        const Cell cell{page.origin.x + static_cast<std::uint32_t>(i),
                        page.origin.y + static_cast<std::uint32_t>(j)};
        const Symbol symbol = symbol_at(pattern.code, cell, pattern.section);
        const auto at = [&](long k, int step) {
            return kFirst_mm + static_cast<double>(k) * pattern.spacing_mm +
                   step * pattern.displacement_mm;
        };
        return std::hypot(x_mm - at(i, dx(symbol)), y_mm - at(j, dy(symbol))) <= radius_mm;
    };
    constexpr int kSamples = 4;
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            int ink = 0;
            for (int k = 0; k < kSamples * kSamples; ++k) {
                ink += is_ink((u + (k % kSamples + 0.5) / kSamples) * mm_per_px,
                              (v + (k / kSamples + 0.5) / kSamples) * mm_per_px);
            }
            image.pixels.push_back(
                static_cast<std::uint8_t>(255 - std::lround(255.0 * ink / kSamples / kSamples)));
        }
    }
    return image;
}

TEST(PageImage, ShowsWhatThePatternShows) {
    Page page;
    page.origin = {5000, 300};
    page.columns = 23;
    page.rows = 18;
    constexpr double kMmPerPx = 25.4 / 2400;
    const GreyImage paper = painted(page, kMmPerPx);
    Imperfections seen;
    seen.blur_sigma_px = 0.6;
    seen.motion_px = {1.2, -0.7};
    seen.vignetting = 0.3;
    seen.fall = 0.2;
    const CameraModel camera;
    // The second view extends past a corner of the dotted area.
    for (const Vec2 at_mm : {Vec2{7.1, 5.63}, Vec2{12, 9.5}}) {
        CameraPose pose;
        pose.cell = page.origin;
        pose.fraction_x = (at_mm.x - kFirst_mm) / page.pattern.spacing_mm;
        pose.fraction_y = (at_mm.y - kFirst_mm) / page.pattern.spacing_mm;
        pose.theta_rad = 0.83;
        pose.tilt_x_rad = radians(12);
        pose.tilt_y_rad = radians(-7);
        const GreyImage expected = render(page, camera, pose, seen, 1);
        const GreyImage image =
            render(PageImage{paper.view(), kMmPerPx, at_mm}, camera, pose, seen, 1);
        ASSERT_EQ(image.pixels.size(), expected.pixels.size());
        int largest = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            largest = std::max(largest, std::abs(image.pixels[i] - expected.pixels[i]));
        // A difference of 2 grey levels is small: dots are about 60 levels darker than the paper,
        // and the level changes by about 30 per pixel at their edges.
        EXPECT_LE(largest, 2);
        EXPECT_LT(*std::min_element(expected.pixels.begin(), expected.pixels.end()), 130);
    }
}

TEST(PageImage, RefusesPixelsWithoutSize) {
    const GreyImage white{std::vector<std::uint8_t>(4, 255), 2, 2};
    EXPECT_THROW(
        render(PageImage{white.view(), 0, {}}, CameraModel{}, CameraPose{}, Imperfections{}, 1),
        BadArgument);
}

}  // namespace
}  // namespace dotpose::simulate_test

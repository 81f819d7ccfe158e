// Tests that images are corrected with the flat field from a camera file.
#include "dotpose/tools/flat_field.hpp"

#include <array>

#include <gtest/gtest.h>

#include "dotpose/tools/evaluate.hpp"
#include "dotpose/tools/follower.hpp"

namespace dotpose {
namespace {

Camera camera_with(std::vector<std::vector<double>> flat_field, int width_px, int height_px) {
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.centre_px = {(width_px - 1) / 2.0, (height_px - 1) / 2.0};
    camera.flat_field = std::move(flat_field);
    return camera;
}

TEST(FlatField, IsInterpolatedBetweenItsValues) {
    // The brightness decreases linearly by half from the first to the last column, and by half from
    // the first to the last row.
    const FlatFieldCorrection correction(camera_with({{1, 0.5}, {0.5, 0.25}}, 3, 3));
    // Grey levels of paper in this light: 200 * (1 - u / 4) * (1 - v / 4).
    const GreyImage paper{{200, 150, 100, 150, 113, 75, 100, 75, 50}, 3, 3};
    for (const int level : correction.corrected(paper.view()).pixels)
        EXPECT_NEAR(level, 200, 1);
    const GreyImage bright{std::vector<std::uint8_t>(9, 100), 3, 3};
    const std::vector<std::uint8_t> expected{100, 133, 200, 133, 178, 255, 200, 255, 255};
    EXPECT_EQ(correction.corrected(bright.view()).pixels, expected);
}

TEST(FlatField, CorrectsRowsWithPadding) {
    const FlatFieldCorrection correction(camera_with({{1, 1}, {0.5, 0.5}}, 2, 2));
    const std::array<std::uint8_t, 6> padded{10, 20, 99, 30, 40, 99};
    const std::vector<std::uint8_t> expected{10, 20, 60, 80};
    EXPECT_EQ(correction.corrected({padded.data(), 2, 2, 3}).pixels, expected);
}

TEST(FlatField, BelongsToOneSizeOfImages) {
    const FlatFieldCorrection correction(camera_with({{1, 1}, {1, 1}}, 4, 3));
    const GreyImage image{std::vector<std::uint8_t>(12), 3, 4};
    EXPECT_THROW(correction.corrected(image.view()), BadArgument);
}

/// Returns the number of frames from an optical mouse sensor that are located on a known sheet.
int located_frames(const FollowerOptions& options) {
    Setup setup;
    setup.preset = Preset::mouse;
    setup.random_section = false;
    setup.camera.width_px = setup.camera.height_px = 36;
    setup.camera.mm_per_px = kDefaultSpacing_mm / 6;
    setup.seed = 1807;
    Follower follower(options);
    int located = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        Shot shot = draw_shot(setup, i);
        shot.pose.cell = {1000 + static_cast<std::uint32_t>(i), 1100};
        shot.imperfections.vignetting = 0.5;
        shot.imperfections.fall = 0;
        shot.imperfections.motion_px = {};
        const Fix fix = follower.locate(render(shot)).fix;
        located += fix.status == Status::ok && fix.cell.x + 1 - shot.pose.cell.x <= 2 ? 1 : 0;
    }
    return located;
}

TEST(FlatField, LetsAFollowerLocateFramesWithVignetting) {
    SheetEntry page;
    page.name = "page";
    page.sheet.columns = page.sheet.rows = 400;
    page.sheet.origin = {900, 900};
    page.sheet.width_mm = page.sheet.height_mm = 400 * kDefaultSpacing_mm;
    FollowerOptions options;
    options.sheets = {page};
    options.has_only_sheets = true;
    const int without = located_frames(options);
    // The simulated brightness decreases with the square of the distance from the image centre, to
    // 1 - vignetting = 0.5 in the corners.
    std::vector<std::vector<double>> field(9, std::vector<double>(9));
    for (int row = 0; row < 9; ++row) {
        for (int column = 0; column < 9; ++column) {
            const double square = (row - 4) * (row - 4) + (column - 4) * (column - 4);
            field[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
                1 - 0.5 * square / 32;
        }
    }
    options.camera = camera_with(field, 36, 36);
    const int with = located_frames(options);
    EXPECT_GE(with, 55);
    EXPECT_LE(without, 45);
}

}  // namespace
}  // namespace dotpose

// What `dotpose locate` says of pictures that it cannot read, or not as they are.
#include <cmath>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::Not;

// 7 x 7 dots or so, all of them clear: not enough to rule out all other places.
TEST_F(LocateCommand, a_position_that_is_not_certain_says_what_was_missing) {
    ASSERT_EQ(ToolCommand::run("simulate -o few --size 84x84 --frames 1 --preset clean --seed 3"),
              0);
    run("few/frame_000000.pgm");
    EXPECT_EQ(records().at(0)["status"], "not_certain");
    EXPECT_THAT(records().at(0)["message"], HasSubstr("no bit contradicts it, but of "));
    EXPECT_THAT(records().at(0)["message"], HasSubstr("show more of the sheet"));
}

/// Without blur and noise.
Shot clean_shot(double px_per_spacing) {
    Setup setup;
    setup.seed = 9;
    setup.preset = Preset::clean;
    setup.camera.mm_per_px = kDefaultSpacing_mm / px_per_spacing;
    return draw_shot(setup, 0);
}

TEST_F(LocateCommand, a_picture_that_is_too_coarse_or_too_dark_says_so) {
    write_pgm(directory_ / "coarse.pgm", render(clean_shot(3.5)).view());
    run("coarse.pgm");
    EXPECT_NE(records().at(0)["status"], "ok");
    EXPECT_THAT(records().at(0)["message"], HasSubstr("its dots are 3.5 px apart and at least 6"));
    Shot dark = clean_shot(11);
    dark.imperfections.paper_level = 9;
    dark.imperfections.noise_sigma = 3;
    write_pgm(directory_ / "dark.pgm", render(dark).view());
    run("dark.pgm");
    EXPECT_NE(records().at(0)["status"], "ok") << output_;
    EXPECT_THAT(records().at(0)["message"], HasSubstr("too dark"));
}

TEST_F(LocateCommand, a_picture_that_is_tilted_out_of_focus_or_shaken_says_so) {
    Shot tilted = clean_shot(14);
    tilted.camera.width_px = 480;
    tilted.camera.height_px = 360;
    tilted.camera.working_distance_mm = 60;
    tilted.pose.tilt_x_rad = 65 * std::numbers::pi / 180;
    write_pgm(directory_ / "tilted.pgm", render(tilted).view());
    run("tilted.pgm");
    EXPECT_NE(records().at(0)["status"], "ok") << output_;
    EXPECT_THAT(records().at(0)["message"], HasSubstr("the sheet is tilted too much, by about 6"));
    EXPECT_THAT(records().at(0)["message"], HasSubstr("degrees: look more straight down on it"));
    Shot blurred = clean_shot(14);
    blurred.camera.width_px = 480;
    blurred.camera.height_px = 360;
    blurred.imperfections.blur_sigma_px = 4;
    blurred.imperfections.noise_sigma = 2;
    write_pgm(directory_ / "blurred.pgm", render(blurred).view());
    run("blurred.pgm");
    EXPECT_NE(records().at(0)["status"], "ok") << output_;
    EXPECT_THAT(records().at(0)["message"], HasSubstr("the picture is out of focus, or shaken"));
    // Sharp pictures of something else are told neither.
    write_pgm(directory_ / "text.pgm", render_scene(Scene::text, clean_shot(14)).view());
    run("text.pgm");
    EXPECT_NE(records().at(0)["status"], "ok") << output_;
    EXPECT_THAT(records().at(0)["message"], Not(HasSubstr("the picture is out of focus")));
    EXPECT_THAT(records().at(0)["message"], Not(HasSubstr("tilted too much")));
}

Shot wide_shot() {
    Setup setup;
    setup.seed = 8;
    setup.camera.width_px = 4201;
    setup.camera.height_px = 301;
    setup.camera.mm_per_px = kDefaultSpacing_mm / 24;
    return draw_shot(setup, 0);
}

// Both sides of the image are no multiple of 2, so that its centre moves when it is reduced.
TEST_F(LocateCommand, an_image_beyond_the_limit_is_reduced_and_that_is_told) {
    const Shot wide = wide_shot();
    write_pgm(directory_ / "wide.pgm", render(wide).view());
    run("wide.pgm");
    EXPECT_EQ(errors_, "dotpose: wide.pgm: reduced from 4201 x 301 to 2100 x 150 px\n");
    const json record = records().at(0);
    ASSERT_EQ(record["status"], "ok") << record;
    EXPECT_NEAR(record["x_grid"], x_grid(wide.pose), 0.005);
    EXPECT_NEAR(record["y_grid"], y_grid(wide.pose), 0.005);
    EXPECT_NEAR(record["spacing_px"], 24, 0.05);
    // Another point of the image: 1000 px along the image x axis.
    run("--reference 3100,150 wide.pgm");
    const double along = 1000.0 / 24;
    EXPECT_NEAR(records().at(0)["x_grid"],
                x_grid(wide.pose) + along * std::cos(wide.pose.theta_rad), 0.01);
    EXPECT_NEAR(records().at(0)["y_grid"],
                y_grid(wide.pose) + along * std::sin(wide.pose.theta_rad), 0.01);
}

TEST_F(LocateCommand, names_a_converter_for_photos_of_phones) {
    write("photo.heic", std::string("\0\0\0\x18"
                                    "ftypheic\0\0\0\0",
                                    16));
    run("photo.heic");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_THAT(errors_, HasSubstr("cannot read photo.heic: a photo in HEIC or AVIF format"));
    EXPECT_THAT(errors_, HasSubstr("heif-convert"));
}

}  // namespace
}  // namespace dotpose::test

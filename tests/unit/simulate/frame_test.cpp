// Tests whole frames: noise statistics, repeatability, presets, page edges, and refusals.
#include <algorithm>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "helpers.hpp"

namespace dotpose::simulate_test {
namespace {

// Returns the FNV-1a checksum of an image.
std::uint64_t checksum(const GreyImage& image) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const std::uint8_t pixel : image.pixels)
        hash = (hash ^ pixel) * 0x100000001B3u;
    return hash;
}

Shot shot_of(Preset preset, std::uint64_t index, std::uint64_t seed = 1) {
    Setup setup;
    setup.preset = preset;
    setup.seed = seed;
    return draw_shot(setup, index);
}

TEST(Frame, SameSeedSameBytesOnEveryMachine) {
    EXPECT_EQ(checksum(render(shot_of(Preset::clean, 0))), 651433147813884346u);
    EXPECT_EQ(checksum(render(shot_of(Preset::nominal, 0))), 15979845519212582951u);
    EXPECT_EQ(checksum(render(shot_of(Preset::hard, 3))), 2503664958487869406u);
}

TEST(Frame, DependsOnSeedAndIndexAlone) {
    const GreyImage alone = render(shot_of(Preset::hard, 7));
    GreyImage elsewhere;
    std::thread other([&] {
        static_cast<void>(render(shot_of(Preset::hard, 6)));
        elsewhere = render(shot_of(Preset::hard, 7));
    });
    other.join();
    EXPECT_EQ(alone.pixels, elsewhere.pixels);
    EXPECT_NE(alone.pixels, render(shot_of(Preset::hard, 8)).pixels);
    EXPECT_NE(alone.pixels, render(shot_of(Preset::hard, 7, 2)).pixels);
}

TEST(Frame, NoiseHasItsMeanDeviationAndTails) {
    Shot shot = shot_of(Preset::clean, 0);
    shot.camera.width_px = 1000;
    shot.camera.height_px = 500;
    shot.imperfections.paper_level = 128;
    shot.imperfections.noise_sigma = 4;
    const GreyImage image = render_scene(Scene::white, shot);
    double sum = 0;
    double square = 0;
    int beyond_3_sigma = 0;
    for (const std::uint8_t pixel : image.pixels) {
        const double error = pixel - 128.0;
        sum += error;
        square += error * error;
        beyond_3_sigma += std::abs(error) > 12.4 ? 1 : 0;
    }
    const auto count = static_cast<double>(image.pixels.size());
    EXPECT_NEAR(sum / count, 0, 0.03);
    EXPECT_NEAR(std::sqrt(square / count), std::sqrt(16 + 1.0 / 12), 0.02);
    // Levels are rounded. A rounded error above 12.4 levels is at least 13, so the error before
    // rounding was at least 12.5 levels, which is 3.125 sigma. A normally distributed error exceeds
    // 3.125 sigma in 0.178 % of all cases.
    EXPECT_NEAR(beyond_3_sigma / count, 0.00178, 0.0003);
}

TEST(Frame, SaltAndPepperHitsTheAskedShare) {
    Shot shot = shot_of(Preset::clean, 0);
    shot.camera.width_px = 1000;
    shot.camera.height_px = 500;
    shot.imperfections.salt_and_pepper = 0.006;
    const GreyImage image = render_scene(Scene::white, shot);
    const auto count = static_cast<double>(image.pixels.size());
    const auto salt = std::count(image.pixels.begin(), image.pixels.end(), 255);
    const auto pepper = std::count(image.pixels.begin(), image.pixels.end(), 0);
    EXPECT_NEAR(static_cast<double>(salt) / count, 0.003, 0.0004);
    EXPECT_NEAR(static_cast<double>(pepper) / count, 0.003, 0.0004);
}

TEST(Frame, LightFallsAsAsked) {
    Shot shot = shot_of(Preset::clean, 0);
    const auto at = [&](int u, int v) {
        const GreyImage image = render_scene(Scene::white, shot);
        return image.pixels[static_cast<std::size_t>(v * image.width_px + u)];
    };
    shot.imperfections.vignetting = 0.5;
    EXPECT_NEAR(at(0, 0), 100, 1);
    EXPECT_NEAR(at(187, 119), 100, 1);
    EXPECT_NEAR(at(93, 59), 200, 1);
    shot.imperfections.vignetting = 0;
    shot.imperfections.fall = 0.4;
    shot.imperfections.fall_direction_rad = 0;
    EXPECT_NEAR(at(187, 60), 160, 1);
    EXPECT_NEAR(at(0, 60), 240, 1);
    EXPECT_NEAR(at(93, 10), 200, 1);
}

TEST(Frame, PaperTextureHasItsDeviation) {
    Shot shot = shot_of(Preset::clean, 0);
    shot.camera.width_px = 600;
    shot.camera.height_px = 600;
    shot.imperfections.texture = 0.05;
    const GreyImage image = render_scene(Scene::white, shot);
    double sum = 0;
    double square = 0;
    for (const std::uint8_t pixel : image.pixels) {
        sum += pixel;
        square += 1.0 * pixel * pixel;
    }
    const auto count = static_cast<double>(image.pixels.size());
    const double mean = sum / count;
    EXPECT_NEAR(mean, 200, 0.3);
    EXPECT_NEAR(std::sqrt(square / count - mean * mean) / mean, 0.05, 0.002);
}

// The texture at a point on the paper must be the same in a large frame and in a frame of one
// pixel.
TEST(Frame, PaperTextureBelongsToThePage) {
    Imperfections seen;
    seen.texture = 0.05;
    CameraModel whole;
    whole.width_px = 101;
    whole.height_px = 61;
    CameraModel pixel;
    pixel.width_px = 1;
    pixel.height_px = 1;
    const auto level = [&](const CameraModel& camera, const CameraPose& pose) {
        return expose({}, simulate::View(camera, pose, seen), Page{}, seen);
    };
    CameraPose pose;
    pose.cell = {5000, 300'000'000};
    const std::vector<float> levels = level(whole, pose);
    const double cells_per_px = whole.mm_per_px / kDefaultSpacing_mm;
    double least = 1e9;
    double most = 0;
    for (int v = 0; v < whole.height_px; v += 5) {
        for (int u = 0; u < whole.width_px; u += 5) {
            CameraPose there = pose;
            there.fraction_x = (u - 50) * cells_per_px;
            there.fraction_y = (v - 30) * cells_per_px;
            const double alone = static_cast<double>(level(pixel, there).front());
            const double in_frame =
                static_cast<double>(levels[static_cast<std::size_t>(v * whole.width_px + u)]);
            ASSERT_NEAR(in_frame, alone, 1e-3) << u << ", " << v;
            least = std::min(least, alone);
            most = std::max(most, alone);
        }
    }
    EXPECT_GT(most - least, 20);  // the standard deviation is 10
}

TEST(Frame, HasAsManyDotsAsCellsInView) {
    const Shot shot = shot_of(Preset::clean, 0);
    const Darkness ink = measure(render(shot).pixels, 188, 200);
    const double cells = 188 * 120 / std::pow(kDefaultSpacing_mm / 0.046, 2);
    const double dot_px2 = std::numbers::pi * std::pow(kDefaultSpacing_mm / 12 / 0.046, 2);
    EXPECT_NEAR(ink.mass, cells * dot_px2 * 0.85, 0.05 * cells * dot_px2);
}

TEST(Frame, LiesWhollyOnThePlane) {
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const CameraPose pose = shot_of(Preset::hard, i).pose;
        // Half the diagonal of the device's frame is 10.1 cells.
        EXPECT_GE(x_grid(pose), 11);
        EXPECT_GE(y_grid(pose), 11);
        EXPECT_LT(x_grid(pose), kPositionsPerAxis - 11.0);
        EXPECT_LT(y_grid(pose), kPositionsPerAxis - 11.0);
        EXPECT_LE(std::abs(pose.theta_rad), std::numbers::pi);
    }
}

TEST(Frame, EndsWithThePage) {
    Shot shot = shot_of(Preset::clean, 0);
    shot.pose.theta_rad = 0;
    shot.pose.fraction_x = 0.5;
    shot.page.origin = {shot.pose.cell.x + 1, shot.pose.cell.y - 50};
    shot.page.columns = 100;
    shot.page.rows = 100;
    const GreyImage image = render(shot);
    for (int v = 0; v < 120; ++v) {
        for (int u = 0; u < 90; ++u) {
            ASSERT_EQ(image.pixels[static_cast<std::size_t>(v * 188 + u)], 200);
        }
    }
    EXPECT_GT(measure(image.pixels, 188, 200).mass, 100);
}

TEST(Frame, PageOfASheetHasTheSheetsDots) {
    Sheet sheet;
    sheet.origin = {100, 200};
    sheet.columns = 30;
    sheet.rows = 40;
    sheet.pattern.section = {3, 4};
    const Page page = page_of(sheet, 9);
    EXPECT_EQ(page.origin, sheet.origin);
    EXPECT_EQ(page.columns, 30u);
    EXPECT_EQ(page.rows, 40u);
    EXPECT_EQ(page.pattern.section, sheet.pattern.section);
    EXPECT_EQ(page.seed, 9u);
}

TEST(Frame, ExtremeSizesAndSpacings) {
    for (const auto& [side_px, spacing_px] :
         {Vec2{1, 6}, Vec2{64, 6}, Vec2{64, 60}, Vec2{1500, 6}}) {
        Shot shot = shot_of(Preset::hard, 1);
        shot.camera.width_px = static_cast<int>(side_px);
        shot.camera.height_px = static_cast<int>(side_px);
        shot.camera.mm_per_px = kDefaultSpacing_mm / spacing_px;
        shot.camera.working_distance_mm = 200;
        EXPECT_EQ(render(shot).pixels.size(), static_cast<std::size_t>(side_px * side_px));
    }
}

TEST(Preset, RangesAreThoseOfTheTable) {
    Rng rng(5);
    int with_graphics = 0;
    int nominal_dirt = 0;
    for (int i = 0; i < 2000; ++i) {
        const Imperfections nominal = draw_imperfections(Preset::nominal, rng);
        EXPECT_TRUE(nominal.paper_level >= 150 && nominal.paper_level <= 220);
        EXPECT_TRUE(nominal.blur_sigma_px >= 0.4 && nominal.blur_sigma_px <= 0.7);
        EXPECT_LE(std::hypot(nominal.motion_px.x, nominal.motion_px.y), 0.5);
        EXPECT_EQ(nominal.graphics, 0);
        nominal_dirt += nominal.dirt_blobs;
        const Imperfections hard = draw_imperfections(Preset::hard, rng);
        EXPECT_TRUE(hard.noise_sigma >= 4 && hard.noise_sigma <= 9);
        EXPECT_LE(std::abs(hard.tilt_x_rad), radians(3));
        EXPECT_EQ(hard.dirt_blobs, 3);
        with_graphics += hard.graphics > 0 ? 1 : 0;
    }
    EXPECT_NEAR(with_graphics / 2000.0, 0.3, 0.04);
    EXPECT_NEAR(nominal_dirt / 2000.0, 0.2, 0.04);
    EXPECT_STREQ(name(Preset::nominal), "nominal");
}

TEST(Frame, TheFixedPatternIsTheSameInEveryFrame) {
    Shot shot = shot_of(Preset::clean, 0);
    shot.imperfections.fixed_pattern = 4;
    const GreyImage a = render_scene(Scene::white, shot);
    ++shot.seed;
    const GreyImage b = render_scene(Scene::white, shot);
    EXPECT_EQ(a.pixels, b.pixels);
    double squares = 0;
    for (const std::uint8_t grey : a.pixels) {
        const double off = grey - shot.imperfections.paper_level;
        squares += off * off;
    }
    // Rounding adds a variance of 1/12.
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(a.pixels.size())), std::sqrt(16 + 1.0 / 12),
                0.1);
}

TEST(Frame, BadValuesAreNamed) {
    const auto message = [](auto change) -> std::string {
        Shot shot = shot_of(Preset::clean, 0);
        change(shot);
        try {
            static_cast<void>(render(shot));
        } catch (const BadArgument& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(message([](Shot& s) { s.camera.width_px = 0; }).find("0 x 120"), std::string::npos);
    EXPECT_NE(message([](Shot& s) { s.camera.k = 1; }).find("distortion"), std::string::npos);
    EXPECT_NE(message([](Shot& s) { s.pose.tilt_x_rad = 1.4; }).find("tilt"), std::string::npos);
    EXPECT_NE(message([](Shot& s) { s.camera.readout_turn_rad = -1.3; }).find("overtake"),
              std::string::npos);
    EXPECT_NE(message([](Shot& s) { s.imperfections.missing = 2; }).find("0 to 1"),
              std::string::npos);
    EXPECT_NE(message([](Shot& s) { s.imperfections.sub_pixels = 1; }).find("0, 2, 4 or 8"),
              std::string::npos);
    EXPECT_NE(message([](Shot& s) { s.pose.theta_rad = NAN; }).find("pose"), std::string::npos);
    EXPECT_NE(message([](Shot& s) { s.page.pattern.section.u = 63; }).find("section"),
              std::string::npos);
}

}  // namespace
}  // namespace dotpose::simulate_test

// Tests `locate` with simulated frames whose poses are known. DOTPOSE_LONG_TESTS=1 in the
// environment increases the number of frames.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

constexpr std::uint64_t kFramesSeed = 2026;

std::uint64_t frames_of(std::uint64_t usual, std::uint64_t many) {
    return std::getenv("DOTPOSE_LONG_TESTS") != nullptr ? many : usual;
}

struct Tally {
    std::uint64_t frames = 0;
    std::uint64_t located = 0;
    std::uint64_t wrong = 0;
    std::vector<double> errors_um;
    std::vector<double> errors_mrad;

    double percentile(std::vector<double> values, double fraction) const {
        std::sort(values.begin(), values.end());
        return values.at(
            static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1)));
    }
    double median_um() const { return percentile(errors_um, 0.5); }
    double located_fraction() const {
        return static_cast<double>(located) / static_cast<double>(frames);
    }
};

/// Adds a fix to the tally. A fix is wrong if its position differs from the true position by more
/// than half a spacing, its angle differs by more than 0.1 rad, or its section differs.
void judge(const Fix& fix, const Shot& shot, Tally& tally) {
    ++tally.frames;
    if (fix.status != Status::ok) return;
    ++tally.located;
    const double spacing_um = 1000 * shot.page.pattern.spacing_mm;
    const double x = fix.x_grid() - x_grid(shot.pose);
    const double y = fix.y_grid() - y_grid(shot.pose);
    const double theta =
        std::remainder(fix.theta_rad() - shot.pose.theta_rad, 2 * std::numbers::pi);
    if (std::hypot(x, y) > 0.5 || std::abs(theta) > 0.1 ||
        fix.section != shot.page.pattern.section) {
        ++tally.wrong;
        ADD_FAILURE() << "wrong fix at cell " << shot.pose.cell.x << ", " << shot.pose.cell.y
                      << ": " << x << ", " << y << " cells and " << theta << " rad off, 2^"
                      << fix.p_wrong_log2 << " sure";
        return;
    }
    tally.errors_um.push_back(std::hypot(x, y) * spacing_um);
    tally.errors_mrad.push_back(std::abs(theta) * 1000);
}

Tally run(const Setup& setup, std::uint64_t frames, const DeviceOptions& options = {}) {
    const auto memory = std::make_unique<LargeMemory>();
    Tally tally;
    for (std::uint64_t i = 0; i < frames; ++i) {
        const Shot shot = draw_shot(setup, i);
        judge(Locator(*memory, options).locate(render(shot).view()), shot, tally);
    }
    return tally;
}

Setup setup_of(Preset preset, std::uint64_t seed = kFramesSeed) {
    Setup setup;
    setup.preset = preset;
    setup.seed = seed;
    return setup;
}

TEST(SimulatedFrames, NominalFramesAreLocated) {
    const Tally tally = run(setup_of(Preset::nominal), frames_of(300, 2000));
    EXPECT_GE(tally.located_fraction(), 0.995) << "seed " << kFramesSeed;
    EXPECT_EQ(tally.wrong, 0u);
    EXPECT_LE(tally.median_um(), 1.2) << "seed " << kFramesSeed;
    // The view is 8.6 mm wide, so an angle error of 1 mrad moves its borders by 4 µm.
    EXPECT_LE(tally.percentile(tally.errors_mrad, 0.5), 1);
}

TEST(SimulatedFrames, CleanFramesAreAllLocated) {
    const Tally tally = run(setup_of(Preset::clean), frames_of(200, 2000));
    EXPECT_EQ(tally.located, tally.frames) << "seed " << kFramesSeed;
    EXPECT_EQ(tally.wrong, 0u);
    EXPECT_LE(tally.median_um(), 1);
}

TEST(SimulatedFrames, HardFramesAreLocated) {
    const Tally tally = run(setup_of(Preset::hard), frames_of(300, 5000));
    EXPECT_EQ(tally.wrong, 0u);
    EXPECT_GE(tally.located_fraction(), 0.98) << "seed " << kFramesSeed;
    EXPECT_LE(tally.median_um(), 2.6) << "seed " << kFramesSeed;
}

TEST(SimulatedFrames, FramesInDoubtAreLookedAtOnceMore) {
    // These frames are dark and noisy, or have graphics along the grid. If their bits are read with
    // the first estimate of the grid, a third of the bits disagree with the code at the true
    // position. In the last frame, the first estimate is rotated by 26 degrees because of printed
    // words.
    const auto memory = std::make_unique<LargeMemory>();
    Tally tally;
    for (const std::uint64_t index :
         {599u, 2270u, 3006u, 3468u, 4166u, 5006u, 5317u, 5590u, 5840u}) {
        const Shot shot = draw_shot(setup_of(Preset::hard, 777), index);
        judge(Locator(*memory, DeviceOptions{}).locate(render(shot).view()), shot, tally);
    }
    EXPECT_EQ(tally.located, tally.frames);
}

TEST(SimulatedFrames, AllProfilesAreRead) {
    for (const CodeVariant code : {CodeVariant::libdots, CodeVariant::microdots}) {
        dotpose::Setup setup = setup_of(Preset::nominal, kFramesSeed + 1);
        setup.pattern.code = code;
        DeviceOptions options;
        options.code = code;
        const Tally tally = run(setup, frames_of(100, 1000), options);
        EXPECT_GE(tally.located_fraction(), 0.99) << static_cast<int>(code);
        EXPECT_EQ(tally.wrong, 0u);
    }
}

TEST(SimulatedFrames, OtherProfilesAreNotTakenForOnesOwn) {
    for (const CodeVariant code : {CodeVariant::anoto, CodeVariant::microdots}) {
        dotpose::Setup setup = setup_of(Preset::nominal, kFramesSeed + 2);
        setup.pattern.code = code;
        DeviceOptions options;
        options.code = code == CodeVariant::anoto ? CodeVariant::microdots : CodeVariant::anoto;
        const Tally tally = run(setup, frames_of(50, 1000), options);
        EXPECT_EQ(tally.located, 0u) << static_cast<int>(code);
    }
}

TEST(SimulatedFrames, BothEndsOfTheCodeAreReadAsTheMiddle) {
    const auto memory = std::make_unique<LargeMemory>();
    // The view extends 10 cells in each direction from its centre, so it is just inside the range
    // of positions.
    constexpr std::uint32_t kNear = 12;
    constexpr std::uint32_t kFar = kPositionsPerAxis - 13;
    Tally tally;
    std::uint64_t index = 0;
    for (std::uint64_t n = 0; n < frames_of(10, 100); ++n) {
        for (const Cell cell : {Cell{kNear, kNear}, Cell{kNear, kFar}, Cell{kFar, kNear},
                                Cell{kFar, kFar}, Cell{kFar, kPositionsPerAxis / 2}}) {
            Shot shot = draw_shot(setup_of(Preset::nominal, kFramesSeed + 3), index++);
            shot.pose.cell = cell;
            judge(Locator(*memory, DeviceOptions{}).locate(render(shot).view()), shot, tally);
        }
    }
    EXPECT_GE(tally.located_fraction(), 0.98) << "seed " << kFramesSeed + 3;
    EXPECT_EQ(tally.wrong, 0u);
}

TEST(SimulatedFrames, EveryDirectionIsRead) {
    const auto memory = std::make_unique<LargeMemory>();
    Tally tally;
    for (int degrees = -180; degrees < 180; degrees += 3) {
        Shot shot = draw_shot(setup_of(Preset::clean, kFramesSeed + 4),
                              static_cast<std::uint64_t>(degrees + 180));
        shot.pose.theta_rad = degrees * std::numbers::pi / 180;
        judge(Locator(*memory, DeviceOptions{}).locate(render(shot).view()), shot, tally);
    }
    EXPECT_EQ(tally.located, tally.frames) << "seed " << kFramesSeed + 4;
    EXPECT_EQ(tally.wrong, 0u);
}

TEST(SimulatedFrames, CamerasOfManySizesAndSpacingsAreRead) {
    struct Camera {
        int width_px, height_px;
        double spacing_px;
    };
    for (const auto& [width, height, spacing] :
         {Camera{96, 96, 8}, Camera{188, 120, 8}, Camera{188, 120, 12}, Camera{320, 240, 10},
          Camera{240, 320, 22}, Camera{640, 480, 12}, Camera{640, 480, 30}, Camera{1280, 720, 60},
          Camera{1600, 1200, 9}}) {
        dotpose::Setup setup = setup_of(Preset::nominal, kFramesSeed + 5);
        setup.camera.width_px = width;
        setup.camera.height_px = height;
        setup.camera.mm_per_px = setup.pattern.spacing_mm / spacing;
        const Tally tally = run(setup, frames_of(6, 100));
        EXPECT_GE(tally.located_fraction(), 0.95)
            << width << " x " << height << " at " << spacing << " px, seed " << setup.seed;
        EXPECT_EQ(tally.wrong, 0u);
    }
}

}  // namespace
}  // namespace dotpose

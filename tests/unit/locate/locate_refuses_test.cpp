// Tests frames that must be refused, and the reasons for their refusal.
#include <map>
#include <memory>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "../core/canvas.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/flip.hpp"
#include "shots.hpp"

namespace dotpose::core_test::locate_refuses_test {
namespace {

constexpr std::uint64_t kSeed = 34;

TEST(LocateRefuses, SizesOutOfRangeAreRefused) {
    SmallMemory small;
    const auto large = std::make_unique<LargeMemory>();
    const auto status_of = [](int width, int height, auto& memory) {
        const GreyImage image = blank(width, height);
        return Locator(memory, DeviceOptions{}).locate(image.view()).status;
    };
    EXPECT_EQ(status_of(63, 120, small), Status::image_too_small);
    EXPECT_EQ(status_of(120, 63, small), Status::image_too_small);
    EXPECT_EQ(status_of(1, 1, small), Status::image_too_small);
    EXPECT_EQ(Locator(small, DeviceOptions{}).locate({}).status, Status::image_too_small);
    EXPECT_EQ(Locator(small, DeviceOptions{}).locate({nullptr, -5, -5, 0}).status,
              Status::image_too_small);
    EXPECT_EQ(status_of(189, 120, small), Status::image_too_large);
    EXPECT_EQ(status_of(64, 4097, *large), Status::image_too_large);
    EXPECT_EQ(Locator(*large, DeviceOptions{}).begin(4097, 64), Status::image_too_large);
    for (const auto& [width, height] :
         {std::pair{64, 64}, std::pair{188, 120}, std::pair{64, 4096}}) {
        EXPECT_EQ(status_of(width, height, small), Status::no_contrast) << width;
    }
}

TEST(LocateRefuses, AFrameWithoutAPositionTellsWhy) {
    // The content of the picture determines which stages can reject it.
    const std::map<Scene, std::set<Status>> allowed{
        {Scene::black, {Status::no_contrast, Status::too_few_dots}},
        {Scene::white, {Status::no_contrast, Status::too_few_dots}},
        {Scene::noise, {Status::too_few_dots, Status::no_grid}},
        {Scene::text, {Status::too_few_dots, Status::no_grid}},
        {Scene::plain_grid, {Status::no_displacement}},
        {Scene::random_symbols, {Status::not_in_code, Status::not_certain, Status::mirrored}},
        {Scene::scattered_dots, {Status::no_grid}},
        {Scene::checkerboard, {Status::too_few_dots, Status::no_grid}},
        {Scene::seam_vertical, {Status::not_certain, Status::not_in_code}},
        {Scene::seam_horizontal, {Status::not_certain, Status::not_in_code}},
        {Scene::mirrored, {Status::mirrored}},
    };
    SmallMemory memory;
    for (const Scene scene : kScenes) {
        for (std::uint64_t i = 0; i < 20; ++i) {
            const GreyImage frame =
                render_scene(scene, shot_of({.preset = Preset::clean}, kSeed, i), 0.8);
            const Status status = Locator(memory, DeviceOptions{}).locate(frame.view()).status;
            EXPECT_TRUE(allowed.at(scene).contains(status))
                << name(scene) << " gave " << name(status) << ", shot " << i << ", seed " << kSeed;
        }
    }
}

TEST(LocateRefuses, AFrameWithoutDotsIsNotNamedByTheDotsOfTheFrameBefore) {
    const auto memory = std::make_unique<LargeMemory>();
    dotpose::Setup setup;
    setup.seed = kSeed;
    const GreyImage frame = render(draw_shot(setup, 1));
    ASSERT_EQ(Locator(*memory, DeviceOptions{}).locate(frame.view()).status, Status::ok);
    const GreyImage black = blank(188, 120);
    EXPECT_EQ(Locator(*memory, DeviceOptions{}).locate(black.view()).status, Status::no_contrast);
}

// If an attempt has found the mirrored code, the status is `mirrored`, even if later attempts fail
// for other reasons.
TEST(LocateRefuses, AMirrorImageIsNamedWhateverTheDisplacement) {
    const auto memory = std::make_unique<LargeMemory>();
    for (const double displacement : {0.12, 1.0 / 6, 0.25, 0.30}) {
        dotpose::Setup setup;
        setup.seed = kSeed;
        setup.camera.width_px = 320;
        setup.camera.height_px = 240;
        setup.pattern.displacement_mm = displacement * setup.pattern.spacing_mm;
        for (std::uint64_t i = 0; i < 5; ++i) {
            const GreyImage frame = render(draw_shot(setup, i));
            SCOPED_TRACE(testing::Message() << displacement << ", shot " << i);
            EXPECT_EQ(Locator(*memory, DeviceOptions{}).locate(frame.view()).status, Status::ok);
            const GreyImage mirrored = flipped(frame.view());
            EXPECT_EQ(Locator(*memory, DeviceOptions{}).locate(mirrored.view()).status,
                      Status::mirrored);
            EXPECT_EQ(Locator(*memory, DeviceOptions{})
                          .locate_in_any_code(mirrored.view(), {})
                          .fix.status,
                      Status::mirrored);
        }
    }
}

TEST(LocateRefuses, AFrameWithoutAnyDotIsRefusedEvenIfNoDotIsAskedFor) {
    // A single dark corner provides contrast, but forms a blob that is too large to be a dot.
    GreyImage image{std::vector<std::uint8_t>(64 * 64, 255), 64, 64};
    for (std::size_t v = 0; v < 32; ++v)
        std::fill_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(64 * v), 32,
                    std::uint8_t{0});
    SmallMemory memory;
    DeviceOptions options;
    options.lattice.min_dots = 0;
    options.blobs.min_area_px = 1 << 20;
    for (const Effort effort : {Effort::device, Effort::twice}) {
        options.effort = effort;
        EXPECT_EQ(Locator(memory, options).locate(image.view()).status, Status::too_few_dots);
    }
    // This attempt accepts any dark minimum as a dot, so it fails only in the search for the grid.
    options.effort = Effort::once;
    EXPECT_EQ(Locator(memory, options).locate(image.view()).status, Status::no_grid);
}

TEST(LocateRefuses, EveryStageCanRefuse) {
    // Each of these combinations of options and frame makes a different stage refuse the frame.
    SmallMemory memory;
    Shot shot = shot_of({.preset = Preset::clean}, kSeed, 0);
    const GreyImage frame = render(shot);
    DeviceOptions options;
    options.integrity.max_p_wrong_log2 = -100000;
    EXPECT_EQ(Locator(memory, options).locate(frame.view()).status, Status::not_certain);
    options = {};
    options.lattice.min_dots = 10000;
    EXPECT_EQ(Locator(memory, options).locate(frame.view()).status, Status::too_few_dots);
    // Another code variant has a different sequence a4, which changes almost all differences
    // between adjacent rolls.
    options = {};
    options.code = CodeVariant::microdots;
    const Status other = Locator(memory, options).locate(frame.view()).status;
    EXPECT_TRUE(other == Status::not_certain || other == Status::not_in_code) << name(other);
    // Only five columns have dots.
    shot.page.origin = {shot.pose.cell.x - 2, shot.pose.cell.y - 30};
    shot.page.columns = 5;
    shot.page.rows = 60;
    shot.pose.theta_rad = radians(90);
    const Status narrow = Locator(memory, DeviceOptions{}).locate(render(shot).view()).status;
    EXPECT_EQ(narrow, Status::grid_too_small) << name(narrow);
}

}  // namespace
}  // namespace dotpose::core_test::locate_refuses_test

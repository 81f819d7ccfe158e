// Tests that a single attempt locates views that are only partly covered by the pattern.
#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/outcome.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

Shot large_shot(std::uint64_t index) {
    Setup setup;
    setup.seed = 91;
    setup.camera.width_px = 640;
    setup.camera.height_px = 480;
    setup.camera.mm_per_px = kDefaultSpacing_mm / 11;
    return draw_shot(setup, index);
}

Shot partial_shot(std::uint64_t index, const PartialView& view) {
    Shot shot = large_shot(index);
    cover_partly(shot, view);
    return shot;
}

/// Returns a view in which strokes and words hide about 60 % of the dots.
Shot shot_with_graphics(std::uint64_t index) {
    Shot shot = large_shot(index);
    shot.imperfections.graphics = 70;
    return shot;
}

void expect_located_at_once(const std::function<Shot(std::uint64_t)>& shot_of) {
    const auto memory = std::make_unique<LargeMemory>();
    DeviceOptions options;
    options.effort = Effort::once;
    for (std::uint64_t i = 0; i < 8; ++i) {
        const Shot shot = shot_of(i);
        const GreyImage image = render(shot);
        Outcome outcome;
        outcome.truth = truth_of(shot);
        outcome.fix = Locator(*memory, options).locate(image.view());
        EXPECT_EQ(outcome.fix.status, Status::ok) << "frame " << i;
        EXPECT_FALSE(outcome.is_wrong()) << "frame " << i;
        // The plane of the fix is relative to the image centre, as predictions require.
        EXPECT_EQ(outcome.fix.pattern_from_image.centre_q8, (FixedVec{639 * 128, 479 * 128}));
        const Fix next =
            Locator(*memory, options).locate(image.view(), Prediction::like(outcome.fix));
        EXPECT_EQ(next.status, Status::ok) << "frame " << i;
    }
}

void expect_located_at_once(const PartialView& view) {
    expect_located_at_once([&](std::uint64_t index) { return partial_shot(index, view); });
}

TEST(PartialViews, BordersAndCornersOnPaperAreLocatedAtOnce) {
    expect_located_at_once(PartialView{});
}

TEST(PartialViews, BordersAndCornersOnADarkTableAreLocatedAtOnce) {
    PartialView view;
    view.on_table = true;
    expect_located_at_once(view);
}

TEST(PartialViews, IslandsAreLocatedAtOnce) {
    PartialView view;
    view.islands = 3;
    expect_located_at_once(view);
}

TEST(PartialViews, DotsAmongGraphicsAreLocatedAtOnce) {
    expect_located_at_once(shot_with_graphics);
}

/// The device attempt starts at the centroid of the dots. Noise on blank paper must not shift this
/// centroid.
TEST(PartialViews, BordersAndCornersAreLocatedByDevices) {
    const auto memory = std::make_unique<LargeMemory>();
    DeviceOptions options;
    options.effort = Effort::device;
    constexpr int kFrames = 30;
    for (const bool on_table : {false, true}) {
        PartialView view;
        view.on_table = on_table;
        int located = 0;
        for (std::uint64_t i = 0; i < kFrames; ++i) {
            const Shot shot = partial_shot(i, view);
            Outcome outcome;
            outcome.truth = truth_of(shot);
            outcome.fix = Locator(*memory, options).locate(render(shot).view());
            EXPECT_FALSE(outcome.is_wrong()) << "frame " << i;
            if (outcome.fix.status != Status::ok) continue;
            ++located;
            EXPECT_EQ(outcome.fix.pattern_from_image.centre_q8, (FixedVec{639 * 128, 479 * 128}));
        }
        EXPECT_GE(located, kFrames * 9 / 10) << (on_table ? "on a table" : "on paper");
    }
}

TEST(PartialViews, CoverWhatTheyShould) {
    // All cells have the same amount of ink. The covered fraction is therefore the ratio of the
    // total darkness of the two images.
    PartialView view;
    view.min_fraction = view.max_fraction = 0.3;
    for (std::uint64_t i = 0; i < 4; ++i) {
        Shot shot = partial_shot(i, view);
        shot.imperfections = {};
        const GreyImage part = render(shot);
        shot.page.areas.clear();
        const GreyImage whole = render(shot);
        const auto darkness = [](const GreyImage& image) {
            double sum = 0;
            for (const int grey : image.pixels)
                sum += 200 - grey;
            return sum;
        };
        EXPECT_NEAR(darkness(part) / darkness(whole), 0.3, 0.02);
    }
}

}  // namespace
}  // namespace dotpose

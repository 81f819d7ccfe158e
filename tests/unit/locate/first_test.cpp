// Tests the first attempt on frames of all sizes, and the results that it stores in the workspace.
#include "locate/first.hpp"

#include <gtest/gtest.h>

#include "../core/canvas.hpp"
#include "core/steps.hpp"
#include "locate/workspace.hpp"
#include "shots.hpp"

namespace dotpose::core_test::first_test {
namespace {

constexpr std::uint64_t kSeed = 81;

Fix outwards(const GreyImage& image, const DeviceOptions& options = {},
             const core::Kernels& kernels = core::kernels()) {
    core::DesktopWorkspace& w = large_workspace();
    w.fix = {};
    w.work = core::WorkLimit(core::WorkLimit::kOfImage);
    if (core::locate_first(w.frame(kernels, image.view(), options), w)) {
        EXPECT_EQ(w.fix.status, Status::ok);
        EXPECT_EQ(w.fix.attempt, Attempt::first);
        return w.fix;
    }
    Fix none;
    none.status = Status::no_grid;
    return none;
}

TEST(LocateFirst, FindsGridsOfAllSpacings) {
    for (const double spacing_px : {6.0, 8.0, 11.0, 20.0, 40.0, 60.0}) {
        const double scale = std::max(spacing_px / 11, 1.0);
        const ShotSize size{spacing_px, static_cast<int>(188 * scale),
                            static_cast<int>(120 * scale), Preset::clean};
        int found = 0;
        for (std::uint64_t i = 0; i < 6; ++i) {
            SCOPED_TRACE(testing::Message() << spacing_px << " px, shot " << i);
            const Shot shot = shot_of(size, kSeed, i);
            const Fix fix = outwards(render(shot));
            if (fix.status != Status::ok) continue;
            ++found;
            EXPECT_TRUE(is_right(fix, shot));
            EXPECT_NEAR(fix.x_grid(), x_grid(shot.pose), 0.02);
            EXPECT_NEAR(fix.y_grid(), y_grid(shot.pose), 0.02);
            EXPECT_NEAR(fix.spacing_px(), spacing_px, 0.02 * spacing_px);
        }
        EXPECT_GE(found, 5) << spacing_px;
    }
}

TEST(LocateFirst, ReadsDotsCutByTheBorderOfSmallImages) {
    constexpr int kFrames = 40;
    const auto found_in = [](const ShotSize& size) {
        int found = 0;
        for (std::uint64_t i = 0; i < kFrames; ++i) {
            const Shot shot = shot_of(size, kSeed, i);
            const Fix fix = outwards(render(shot));
            if (fix.status != Status::ok) continue;
            ++found;
            EXPECT_TRUE(is_right(fix, shot)) << size.spacing_px << " px, shot " << i;
        }
        return found;
    };
    EXPECT_GE(found_in({7, 64, 64}), kFrames * 6 / 10);
    EXPECT_GE(found_in({9, 80, 80}), kFrames * 4 / 10);
}

TEST(LocateFirst, SettlesImagesWithTooFewCells) {
    constexpr int kFrames = 20;
    int settled = 0;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        outwards(render(shot_of({9, 64, 64}, kSeed, i)));
        settled += large_workspace().measurement.shows_too_few_cells ? 1 : 0;
    }
    EXPECT_GE(settled, kFrames * 9 / 10);
}

TEST(LocateFirst, SettlesImagesWithTooFewDotsBeforeTheirGrid) {
    for (std::uint64_t i = 0; i < 20; ++i) {
        outwards(render(shot_of({11, 64, 64}, kSeed, i)));
        EXPECT_EQ(large_workspace().fix.status, Status::too_few_dots) << "shot " << i;
        EXPECT_TRUE(large_workspace().measurement.shows_too_few_cells) << "shot " << i;
    }
}

TEST(LocateFirst, SettlesSmallViewsWithFewCells) {
    int found = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        // A view of 64 cells is too small. The attempt must report this even if some dots are not
        // clear.
        const Fix fix = outwards(render(shot_of({9, 72, 72, Preset::nominal}, kSeed, i)));
        EXPECT_NE(fix.status, Status::ok) << "shot " << i;
        found += large_workspace().measurement.shows_too_few_cells ? 1 : 0;
    }
    EXPECT_EQ(found, 100);
}

TEST(LocateFirst, SettlesSmallViewsWithClearDots) {
    int left = 0;
    int settled = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        const Fix fix = outwards(render(shot_of({11, 96, 96}, kSeed, i)));
        if (fix.status == Status::ok) continue;
        ++left;
        settled += large_workspace().measurement.shows_too_few_cells ? 1 : 0;
    }
    EXPECT_GE(left, 20);
    EXPECT_GE(settled, left * 9 / 10);
}

TEST(LocateFirst, FindsAllProfilesAtEveryTurn) {
    int found = 0;
    constexpr int kFrames = 36;
    for (int i = 0; i < kFrames; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        DeviceOptions options;
        options.code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        Shot shot = shot_of({.code = options.code}, kSeed, static_cast<std::uint64_t>(i));
        shot.pose.theta_rad = radians(10 * i);
        const Fix fix = outwards(render(shot), options);
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_TRUE(is_right(fix, shot));
    }
    EXPECT_GE(found, kFrames * 9 / 10);
}

TEST(LocateFirst, LooksThroughTheLensThatItIsTold) {
    for (std::uint64_t i = 0; i < 10; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        Shot shot = shot_of({}, kSeed, i);
        shot.camera.k = i % 2 == 0 ? -8e-6 : 8e-6;
        DeviceOptions options;
        options.lens = FixedLens::from_k(shot.camera.k);
        const Fix fix = outwards(render(shot), options);
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_TRUE(is_right(fix, shot));
        EXPECT_NEAR(fix.x_grid(), x_grid(shot.pose), 0.02);
        EXPECT_NEAR(fix.y_grid(), y_grid(shot.pose), 0.02);
    }
}

TEST(LocateFirst, FindsFramesAcrossTheEndsOfThePlane) {
    Rng rng(kSeed);
    int found = 0;
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        View view = random_view(rng);
        view.code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        if (i % 2 == 0) view.place.cell.x = i % 4 == 0 ? 1 : kPositionsPerAxis - 2;
        if (i % 3 != 1) view.place.cell.y = i % 4 < 2 ? kPositionsPerAxis - 1 : 0;
        GreyImage image = blank(188, 120);
        for (const PlacedDot& dot : pattern_dots(view))
            darken(image, dot.centre_px, 1.4, 0.7);
        DeviceOptions options;
        options.code = view.code;
        const Fix fix = outwards(image, options);
        if (fix.status != Status::ok) continue;
        ++found;
        EXPECT_EQ(fix.cell, view.place.cell);
        EXPECT_EQ(fix.section, view.place.section);
        EXPECT_NEAR(fix.fraction_x_q16 / 65536.0, view.at_centre.x, 0.02);
        EXPECT_NEAR(fix.fraction_y_q16 / 65536.0, view.at_centre.y, 0.02);
    }
    EXPECT_GE(found, 11);
}

TEST(LocateFirst, RefusesWhatShowsNoPosition) {
    for (const Scene scene : kScenes) {
        const bool is_seam = scene == Scene::seam_vertical || scene == Scene::seam_horizontal;
        for (std::uint64_t i = 0; i < 8; ++i) {
            SCOPED_TRACE(testing::Message() << name(scene) << " " << i);
            const Shot shot = shot_of({}, kSeed, i);
            const Fix fix = outwards(render_scene(scene, shot, 0.2 + 0.1 * static_cast<double>(i)));
            if (!is_seam) {
                EXPECT_NE(fix.status, Status::ok);
            } else if (fix.status == Status::ok) {
                // The fix may belong to the pattern on either side of the seam.
                EXPECT_NEAR(fix.x_grid(), x_grid(shot.pose), 1);
                EXPECT_NEAR(fix.y_grid(), y_grid(shot.pose), 1);
            }
        }
    }
}

TEST(LocateFirst, UsesAsManyDotsAsItMay) {
    const Shot shot = shot_of({11, 640, 480}, kSeed, 0);
    const GreyImage image = render(shot);
    const int all = outwards(image).dots_used;
    EXPECT_GT(all, 1500);
    for (const int most : {100, 300, 1000}) {
        DeviceOptions options;
        options.max_dots = most;
        const Fix fix = outwards(image, options);
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_TRUE(is_right(fix, shot));
        EXPECT_LE(fix.dots_used, most * 5 / 4);
        EXPECT_GE(fix.dots_used, most / 3);
    }
}

TEST(LocateFirst, ShowsItsDotsAndCellsWhenAsked) {
    static LargeWorkspace blobs;
    for (std::uint64_t i = 0; i < 6; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const Shot shot = shot_of({11, 188, 120, Preset::clean}, kSeed, i);
        const GreyImage image = render(shot);
        DeviceOptions options;
        options.show_stages = true;
        const Fix fix = outwards(image, options);
        ASSERT_EQ(fix.status, Status::ok);
        const Workspace& w = large_workspace();
        core::detect_image(image.view(), options, blobs);
        ASSERT_EQ(core::find_dots(options, blobs), Status::ok);
        EXPECT_GE(w.dot_count, blobs.dot_count * 9 / 10);
        EXPECT_LE(w.dot_count, blobs.dot_count * 11 / 10);
        const auto found = blobs.found_dots();
        const std::vector<DetectedDot> others(found.begin(), found.end());
        int read = 0;
        int alone = 0;
        for (int j = w.grid.j0; j < w.grid.j0 + w.grid.rows; ++j) {
            for (int k = w.grid.i0; k < w.grid.i0 + w.grid.columns; ++k) {
                const GridCell& cell = w.grid.at(k, j);
                if (!cell.has_dot()) continue;
                ++read;
                const Vec2 at = real(w.found_dots()[cell.dot].centre_q8, 8);
                // Dots near the border are not tested, because blobs are cut off at the border.
                const bool is_inside = at.x > 6 && at.y > 6 && at.x < 181 && at.y < 113;
                const double off_px = nearest_px(others, at);
                // If a dot touches another dot, the two form one blob or none, so there may be no
                // blob near its centre.
                if (is_inside && off_px > 5) ++alone;
                EXPECT_TRUE(!is_inside || off_px < 0.3 || off_px > 5) << off_px;
                const Place place = moved(options.code, w.decoding.place, k, j);
                const Symbol symbol = symbol_at(options.code, place.cell, place.section);
                EXPECT_EQ(cell.x > 0, x_bit(symbol) == 1);
                EXPECT_EQ(cell.y > 0, y_bit(symbol) == 1);
            }
        }
        EXPECT_EQ(read, w.dot_count);
        EXPECT_LE(alone, 2);
        // Without `show_stages`, the attempt stores no dots.
        options.show_stages = false;
        static_cast<void>(outwards(image, options));
        EXPECT_EQ(w.dot_count, 0);
    }
}

TEST(LocateFirst, AllFormsOfTheKernelsGiveTheSame) {
    for (int i = 0; i < 16; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const ShotSize size{i % 3 == 0 ? 30.0 : 9.0, 188 + 17 * i, 120 + 9 * i,
                            i % 4 == 3 ? Preset::hard : Preset::nominal};
        const GreyImage image = render(shot_of(size, kSeed, static_cast<std::uint64_t>(i)));
        const auto forms = kernel_forms();
        const Fix reference = outwards(image, {}, *forms[0]);
        for (const core::Kernels* form : forms) {
            SCOPED_TRACE(form->name);
            expect_same_bits(outwards(image, {}, *form), reference);
        }
    }
}

TEST(LocateFirst, ALensThatFoldsTheImageBreaksNothing) {
    const Shot shot = shot_of({}, kSeed, 3);
    const GreyImage image = render(shot);
    for (const std::int32_t k_q40 : {INT32_MIN, INT32_MIN / 16, INT32_MAX / 16, INT32_MAX}) {
        DeviceOptions options;
        options.lens.k_q40 = k_q40;
        options.show_stages = true;
        const Fix fix = outwards(image, options);
        EXPECT_TRUE(fix.status != Status::ok || is_right(fix, shot)) << k_q40;
    }
}

}  // namespace
}  // namespace dotpose::core_test::first_test

// Tests which frames reach the second attempt, and which frames can be located only by the second
// attempt.
#include "locate/second.hpp"

#include <gtest/gtest.h>

#include "../../alike_frames.hpp"
#include "locate/confirm.hpp"
#include "locate/first.hpp"
#include "locate/locate.hpp"
#include "locate/workspace.hpp"
#include "shots.hpp"

namespace dotpose::core_test::second_test {
namespace {

constexpr std::uint64_t kSeed = 93;

/// Returns a frame of clean dots that are 6 grey levels darker than the paper.
Shot pale_shot(std::uint64_t index) {
    Shot shot = shot_of({.spacing_px = 8}, kSeed, index);
    shot.imperfections = {};
    shot.imperfections.noise_sigma = 3;
    shot.imperfections.blur_sigma_px = 1.5;
    shot.page.pattern.dot_mm = 0.10 * shot.page.pattern.spacing_mm;
    return shot;
}

TEST(SecondAttempt, SeesDotsPalerThanTheLeastContrast) {
    for (std::uint64_t i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const Shot shot = pale_shot(i);
        const Fix fix = core::locate(render(shot).view(), {}, nullptr, large_workspace());
        ASSERT_EQ(fix.status, Status::ok);
        EXPECT_EQ(fix.attempt, Attempt::second);
        EXPECT_TRUE(is_right(fix, shot));
    }
}

TEST(SecondAttempt, NoiseWithoutDotsIsRefusedAsThat) {
    for (std::uint64_t i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        Shot shot = pale_shot(i);
        shot.imperfections.noise_sigma = 5;
        shot.page.pattern.dot_mm = 1e-4;
        const Fix fix = core::locate(render(shot).view(), {}, nullptr, large_workspace());
        EXPECT_TRUE(fix.status == Status::no_contrast || fix.status == Status::too_few_dots);
        EXPECT_LT(fix.dots_seen, DeviceOptions{}.lattice.min_dots);
    }
}

TEST(SecondAttempt, DotsThatFallOnThePixelsAlikeAreNotBiased) {
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const Shot shot = test::shot_of(
            test::AlikeDots{.spacing_px = 12, .blur_px = 0.3, .angle_deg = 90}, kSeed, i);
        const GreyImage image = render(shot);
        core::DesktopWorkspace& w = large_workspace();
        ASSERT_TRUE(core::SecondAttempt(w).read(w.frame(core::kernels(), image.view(), {}),
                                                core::SecondAttempt::Resampling::if_doubtful));
        const Fix fix = w.fix;
        EXPECT_EQ(fix.attempt, Attempt::second);
        // Without the correction of the pixel bias, the error would be up to 0.01 spacings, which
        // is 50 standard deviations.
        EXPECT_LT(std::abs(fix.x_grid() - x_grid(shot.pose)), 5 * std::sqrt(fix.covariance[0][0]));
        EXPECT_LT(std::abs(fix.y_grid() - y_grid(shot.pose)), 5 * std::sqrt(fix.covariance[1][1]));
    }
}

TEST(SecondAttempt, ReadsRoughFramesThatTheFirstLeavesOpen) {
    core::DesktopWorkspace& w = large_workspace();
    int left = 0;
    int read = 0;
    for (std::uint64_t i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i << ", seed " << kSeed);
        const Shot shot = shot_of({.preset = Preset::hard}, kSeed, i);
        const GreyImage image = render(shot);
        if (core::locate_first(w.frame(core::kernels(), image.view(), {}), w) &&
            !core::is_rough(w.fix))
            continue;
        ++left;
        const Fix fix = core::locate(image.view(), {}, nullptr, w);
        if (fix.status != Status::ok) continue;
        ++read;
        EXPECT_EQ(fix.attempt, Attempt::second);
        EXPECT_TRUE(is_right(fix, shot));
    }
    EXPECT_GT(left, 5);
    EXPECT_GE(read, left * 9 / 10);
}

}  // namespace
}  // namespace dotpose::core_test::second_test

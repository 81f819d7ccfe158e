// Tests locators that receive the motion between frames. The locators combine the bits of several
// frames, and predict the next frame from the motion.
#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "shots.hpp"

namespace dotpose::core_test::motion_test {
namespace {

constexpr std::uint64_t kSeed = 7171;
constexpr KnownRegion kSheet{CodeVariant::anoto, {}, {1024, 2048}, 393, 564};

/// Returns the shot that is taken after `motion`: a displacement in mm, along the image axes of
/// `shot`, and a rotation. The noise and the light differ from those of `shot`.
Shot moved_shot(const Shot& shot, const MeasuredMotion& motion) {
    Shot next = shot;
    CameraPose& pose = next.pose;
    const double spacing_mm = shot.page.pattern.spacing_mm;
    const double c = std::cos(pose.theta_rad);
    const double s = std::sin(pose.theta_rad);
    const double right = static_cast<double>(motion.right_mm) / spacing_mm;
    const double down = static_cast<double>(motion.down_mm) / spacing_mm;
    const double x = pose.fraction_x + c * right - s * down;
    const double y = pose.fraction_y + s * right + c * down;
    pose.cell.x = static_cast<std::uint32_t>(static_cast<std::int64_t>(pose.cell.x) +
                                             static_cast<std::int64_t>(std::floor(x)));
    pose.cell.y = static_cast<std::uint32_t>(static_cast<std::int64_t>(pose.cell.y) +
                                             static_cast<std::int64_t>(std::floor(y)));
    pose.fraction_x = x - std::floor(x);
    pose.fraction_y = y - std::floor(y);
    pose.theta_rad =
        std::remainder(pose.theta_rad + static_cast<double>(motion.turn_rad), 2 * std::numbers::pi);
    ++next.seed;
    return next;
}

/// Returns a random motion: a displacement of `view_mm` / 2 in a random direction, and a rotation
/// of up to 0.5 rad.
MeasuredMotion draw_motion(double view_mm, Rng& rng) {
    const double direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    MeasuredMotion motion;
    motion.right_mm = static_cast<float>(view_mm / 2 * std::cos(direction_rad));
    motion.down_mm = static_cast<float>(view_mm / 2 * std::sin(direction_rad));
    motion.turn_rad = static_cast<float>(rng.uniform(-0.5, 0.5));
    return motion;
}

/// Returns a measurement of a motion: the true motion plus normally distributed errors.
MeasuredMotion measured(const MeasuredMotion& motion, float sigma_mm, float sigma_rad, Rng& rng) {
    MeasuredMotion seen = motion;
    seen.right_mm += static_cast<float>(rng.normal()) * sigma_mm;
    seen.down_mm += static_cast<float>(rng.normal()) * sigma_mm;
    seen.turn_rad += static_cast<float>(rng.normal()) * sigma_rad;
    seen.sigma_mm = sigma_mm;
    seen.sigma_rad = sigma_rad;
    return seen;
}

Shot shot_on_sheet(const ShotSize& size, std::uint64_t index) {
    Shot shot = shot_of(size, kSeed, index);
    Rng rng(shot.seed, 1);
    shot.page.pattern.section = kSheet.section;
    shot.pose.cell = {kSheet.first.x + 40 + rng.below(kSheet.columns - 80),
                      kSheet.first.y + 40 + rng.below(kSheet.rows - 80)};
    return shot;
}

constexpr int kLength = 6;

/// Results of several series of `kLength` frames each.
struct Series {
    /// Element k is the number of series that have a fix in their first k + 1 frames.
    std::array<int, kLength> located{};
    int with_earlier = 0;  ///< number of fixes that combine several frames
    int wrong = 0;
};

Series run_series(Locator& locator, const ShotSize& size, int count, float sigma_mm,
                  float sigma_rad, bool is_on_sheet) {
    Series series;
    for (int i = 0; i < count; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        Shot shot = is_on_sheet ? shot_on_sheet(size, index) : shot_of(size, kSeed, index);
        Rng rng(kSeed, 1'000'000 + index);
        // Calling `locate` without a measured motion ends the previous series.
        static_cast<void>(locator.locate(render_scene(Scene::white, shot).view()));
        MeasuredMotion motion;
        bool is_located = false;
        for (std::size_t k = 0; k < kLength; ++k) {
            const Fix fix = locator.locate(render(shot).view(), motion);
            if (fix) {
                is_located = true;
                series.with_earlier += fix.frames > 1 ? 1 : 0;
                series.wrong += is_right(fix, shot) ? 0 : 1;
            }
            series.located[k] += is_located ? 1 : 0;
            const double view_mm = size.width_px * shot.camera.mm_per_px;
            const MeasuredMotion truth = draw_motion(view_mm, rng);
            shot = moved_shot(shot, truth);
            motion = measured(truth, sigma_mm, sigma_rad, rng);
        }
    }
    return series;
}

TEST(MeasuredMotion, FollowsAnotherMotion) {
    const MeasuredMotion quarter{.turn_rad = std::numbers::pi_v<float> / 2, .sigma_rad = 0.01F};
    const MeasuredMotion ahead{.right_mm = 3, .sigma_mm = 0.04F};
    const MeasuredMotion both = followed_by(quarter, ahead);
    EXPECT_NEAR(both.right_mm, 0, 1e-6);
    EXPECT_NEAR(both.down_mm, 3, 1e-6);
    EXPECT_NEAR(both.sigma_mm, 0.05, 1e-6);  // 3 mm * 0.01 rad and 0.04 mm, added in quadrature
    EXPECT_NEAR(both.turn_rad, std::numbers::pi / 2, 1e-6);
}

class FramesReadTogether : public testing::Test {
  protected:
    std::unique_ptr<LargeMemory> memory_ = std::make_unique<LargeMemory>();
    Locator locator_{*memory_, DeviceOptions{}};
};

// A single view of 7.3 x 7.3 cells is never certain if the sheets are not known.
TEST_F(FramesReadTogether, SmallViewsOfTheWholePlaneBecomeCertain) {
    const Series series =
        run_series(locator_, {.width_px = 80, .height_px = 80}, 40, 0.02F, 0.005F, false);
    EXPECT_EQ(series.wrong, 0);
    EXPECT_EQ(series.located[0], 0);
    EXPECT_GE(series.located[3], 35);
    EXPECT_EQ(series.located[5], 40);
    EXPECT_GT(series.with_earlier, 100);
}

// A single view of 4.9 x 4.9 cells is rarely certain, even if the sheets are known.
TEST_F(FramesReadTogether, SmallViewsOfKnownSheetsBecomeCertain) {
    ASSERT_EQ(locator_.set_known({&kSheet, 1}, OtherSheets::impossible), Status::ok);
    const Series series =
        run_series(locator_, {.width_px = 54, .height_px = 54}, 40, 0.02F, 0.005F, true);
    EXPECT_EQ(series.wrong, 0);
    EXPECT_LE(series.located[0], 5);
    EXPECT_GE(series.located[1], 35);
    EXPECT_EQ(series.located[3], 40);
}

// Only the order of magnitude of the motion is known. The exact motion can be computed from the
// dots that two frames have in common.
TEST_F(FramesReadTogether, CommonDotsReplaceAnInaccurateMotion) {
    const Series series =
        run_series(locator_, {.width_px = 90, .height_px = 90}, 40, 0.8F, 0.3F, false);
    EXPECT_EQ(series.wrong, 0);
    EXPECT_EQ(series.located[0], 0);
    EXPECT_GE(series.located[1], 33);
    EXPECT_EQ(series.located[5], 40);
}

// Before each frame, the robot is put down at another position, but its odometry reports no motion.
// No frame may be located, because a fix would combine bits from different places.
TEST_F(FramesReadTogether, AWrongMotionGivesNoWrongFix) {
    constexpr ShotSize kSize{.width_px = 80, .height_px = 80};
    const MeasuredMotion none{.sigma_mm = 0.05F, .sigma_rad = 0.02F};
    int located = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const Shot shot = shot_of(kSize, kSeed, i);
        const Fix fix = locator_.locate(render(shot).view(), none);
        located += fix ? 1 : 0;
        EXPECT_TRUE(!fix || is_right(fix, shot)) << "frame " << i;
    }
    EXPECT_EQ(located, 0);
}

// Between the views of a series, there are frames without a pattern. The motions of these frames
// must be accumulated, but the frames must have no other effect.
TEST_F(FramesReadTogether, FramesWithoutAPatternAreSkipped) {
    constexpr ShotSize kSize{.width_px = 80, .height_px = 80};
    int located = 0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        Shot shot = shot_of(kSize, kSeed, i);
        static_cast<void>(locator_.locate(render(shot).view()));
        MeasuredMotion motion;
        Rng rng(kSeed, i);
        for (int k = 0; k < 9; ++k) {
            const bool is_blank = k % 2 == 1;
            const GreyImage image = is_blank ? render_scene(Scene::white, shot) : render(shot);
            const Fix fix = locator_.locate(image.view(), motion);
            EXPECT_TRUE(!fix || is_right(fix, shot)) << "series " << i << ", frame " << k;
            if (k == 8) located += fix && fix.frames > 3 ? 1 : 0;
            motion = {.right_mm = 1.0F, .turn_rad = 0.1F, .sigma_mm = 0.01F, .sigma_rad = 0.003F};
            shot = moved_shot(shot, motion);
        }
    }
    EXPECT_GE(located, 16);
}

TEST_F(FramesReadTogether, ALocatorDoesNotContinueTheSeriesOfAnEarlierOne) {
    const Shot shot = shot_of({.width_px = 80, .height_px = 80}, kSeed, 0);
    const MeasuredMotion motion{
        .right_mm = 1.5F, .down_mm = 1.5F, .sigma_mm = 0.02F, .sigma_rad = 0.005F};
    Shot next = shot;
    for (int k = 0; k < 6; ++k) {
        static_cast<void>(locator_.locate(render(next).view(), motion));
        next = moved_shot(next, motion);
    }
    ASSERT_GT(locator_.locate(render(next).view(), motion).frames, 1);
    Locator other{*memory_, DeviceOptions{}};
    EXPECT_FALSE(other.locate(render(moved_shot(next, motion)).view(), motion));
}

// After a fix, the next frame is predicted from the motion, so the tracked attempt can locate it.
TEST_F(FramesReadTogether, AMotionPredictsTheNextFrame) {
    Shot shot = shot_of({}, kSeed, 3);
    const MeasuredMotion motion{.right_mm = 2.5F,
                                .down_mm = -1.5F,
                                .turn_rad = 0.4F,
                                .sigma_mm = 0.02F,
                                .sigma_rad = 0.01F};
    ASSERT_TRUE(locator_.locate(render(shot).view()));
    for (int k = 0; k < 5; ++k) {
        shot = moved_shot(shot, motion);
        const Fix fix = locator_.locate(render(shot).view(), motion);
        ASSERT_TRUE(fix);
        EXPECT_TRUE(is_right(fix, shot));
        EXPECT_EQ(fix.attempt, Attempt::tracked);
        EXPECT_EQ(fix.frames, 1);
    }
}

}  // namespace
}  // namespace dotpose::core_test::motion_test

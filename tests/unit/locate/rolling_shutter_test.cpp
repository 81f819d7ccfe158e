// Tests the first attempt on frames from a rolling-shutter camera, in which the scene moves while
// the rows are read.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"
#include "shots.hpp"

namespace dotpose::core_test::rolling_shutter_test {
namespace {

constexpr std::uint64_t kSeed = 77;
constexpr int kDirections = 12;
/// Spacing and size of the frames. A frame shows 24 rows of cells if nothing moves, and at least 9
/// rows with any motion in these tests.
constexpr ShotSize kSize{.spacing_px = 20, .width_px = 640, .height_px = 480};

/// Returns a frame whose scene moves during the readout by `motion` times the height of the image,
/// in one of kDirections directions.
Shot moved_shot(double motion, int direction) {
    Shot shot = shot_of(kSize, kSeed, static_cast<std::uint64_t>(direction));
    const double angle_rad = 2 * std::numbers::pi * (direction + 0.5) / kDirections;
    shot.camera.readout_px = {motion * kSize.height_px * std::cos(angle_rad),
                              motion * kSize.height_px * std::sin(angle_rad)};
    return shot;
}

TEST(RollingShutter, FramesAreLocatedAtTheFirstAttemptForTheMiddleRow) {
    DeviceOptions options;
    options.effort = Effort::once;
    Locator locator(options);
    for (const double motion : {0.1, 0.3, 0.45, 0.6}) {
        int located = 0;
        for (int i = 0; i < kDirections; ++i) {
            const Shot shot = moved_shot(motion, i);
            const Fix fix = locator.locate(render(shot).view());
            if (fix.status != Status::ok) continue;
            ++located;
            EXPECT_TRUE(is_right(fix, shot)) << motion << ", direction " << i;
            // A hundredth of a spacing is 5 um.
            EXPECT_NEAR(fix.x_grid(), x_grid(shot.pose), 0.01) << motion << ", direction " << i;
            EXPECT_NEAR(fix.y_grid(), y_grid(shot.pose), 0.01) << motion << ", direction " << i;
        }
        EXPECT_GE(located, kDirections - 1) << motion;
    }
}

/// Returns the rms position error of frames of 188 x 120 px, in spacings. The scene moves during
/// the readout by `motion` times the height of the image, in any direction.
double rms_error(double motion) {
    Locator locator{DeviceOptions{}};
    constexpr int kFrames = 200;
    const ShotSize size;
    double squares = 0;
    for (int i = 0; i < kFrames; ++i) {
        Shot shot = shot_of(size, kSeed, static_cast<std::uint64_t>(i));
        const double angle_rad = 2 * std::numbers::pi * (i + 0.5) / kFrames;
        shot.camera.readout_px = {motion * size.height_px * std::cos(angle_rad),
                                  motion * size.height_px * std::sin(angle_rad)};
        const Fix fix = locator.locate(render(shot).view());
        EXPECT_EQ(fix.status, Status::ok) << motion << ", shot " << i;
        squares += std::pow(fix.x_grid() - x_grid(shot.pose), 2) +
                   std::pow(fix.y_grid() - y_grid(shot.pose), 2);
    }
    return std::sqrt(squares / kFrames);
}

/// Regression: the shear was mistaken for perspective. Perspective was then fitted without a prior,
/// which increased the error by a quarter.
TEST(RollingShutter, MotionDoesNotIncreaseTheError) {
    const double still = rms_error(0);
    EXPECT_LT(rms_error(0.1), 1.05 * still);
    EXPECT_LT(rms_error(0.2), 1.1 * still);
}

void set_bit(core::BitLines& lines, int line, int cell, int bit) {
    const auto i = static_cast<std::size_t>(line + core::BitBlock::kMiddle);
    lines.valid[i] |= std::uint64_t{1} << (cell + core::BitBlock::kMiddle);
    lines.bits[i] |= static_cast<std::uint64_t>(bit) << (cell + core::BitBlock::kMiddle);
}

/// Returns the bits of the dots that are completely in the image. `place` is the place of cell (0,
/// 0) of the block.
core::BitBlock bits_in_view(const Shot& shot, const Place& place) {
    constexpr int kReach = 30;
    constexpr double kMargin_px = 2;
    const Pattern& pattern = shot.page.pattern;
    const Projection projection(shot.camera, shot.pose);
    core::BitBlock block;
    for (int j = -kReach; j < kReach; ++j) {
        for (int i = -kReach; i < kReach; ++i) {
            const Place at = moved(pattern.code, place, i, j);
            const Symbol symbol = symbol_at(pattern.code, at.cell, at.section);
            const Vec2 seen =
                projection.pixel_from_offset({(i - shot.pose.fraction_x) * pattern.spacing_mm +
                                                  dx(symbol) * pattern.displacement_mm,
                                              (j - shot.pose.fraction_y) * pattern.spacing_mm +
                                                  dy(symbol) * pattern.displacement_mm});
            if (std::min(seen.x, seen.y) < kMargin_px ||
                seen.x > shot.camera.width_px - 1 - kMargin_px ||
                seen.y > shot.camera.height_px - 1 - kMargin_px)
                continue;
            set_bit(block.columns, i, j, x_bit(symbol));
            set_bit(block.rows, j, i, y_bit(symbol));
        }
    }
    return block;
}

/// Returns true if the dots in view would make the position certain if they were read without
/// error.
bool carries_position(const Shot& shot) {
    const CodeVariant code = shot.page.pattern.code;
    const Place place{shot.pose.cell, shot.page.pattern.section};
    const core::BitBlock block = bits_in_view(shot, place);
    std::array<core::ScoredLine, 128> scores{};
    const auto bits = core::compared_with_code(code, place, block);
    Fix fix;
    core::WorkLimit work(core::WorkLimit::kOfImage);
    return core::is_certain(core::kernels(),
                            core::evidence_of(core::kernels(), code, place, block, bits, scores),
                            code, IntegrityOptions{}, work, fix);
}

TEST(RollingShutter, SmallFramesAreLocatedAtTheFirstAttemptIfTheirDotsCarryThePosition) {
    DeviceOptions options;
    options.effort = Effort::once;
    Locator locator(options);
    constexpr int kFrames = 200;
    const ShotSize size;
    int carrying = 0;
    int missed = 0;
    for (int i = 0; i < kFrames; ++i) {
        SCOPED_TRACE(testing::Message() << "shot " << i);
        Shot shot = shot_of(size, kSeed, static_cast<std::uint64_t>(i));
        // The direction of the motion is within 45 degrees of straight down. Such a motion
        // stretches the image of the scene, so the frame contains only 40 to 58 % of the usual
        // number of cells.
        const double angle_rad = std::numbers::pi / 4 * (1 + 2 * (i + 0.5) / kFrames);
        shot.camera.readout_px = {0.6 * size.height_px * std::cos(angle_rad),
                                  0.6 * size.height_px * std::sin(angle_rad)};
        const Fix fix = locator.locate(render(shot).view());
        const bool is_located = fix.status == Status::ok;
        if (is_located) {
            EXPECT_TRUE(is_right(fix, shot));
        }
        if (!carries_position(shot)) continue;
        ++carrying;
        missed += is_located ? 0 : 1;
    }
    EXPECT_GE(carrying, kFrames / 3);
    EXPECT_LE(100 * missed, carrying);
}

}  // namespace
}  // namespace dotpose::core_test::rolling_shutter_test

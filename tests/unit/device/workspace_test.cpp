// Tests that device workspaces for several frame sizes locate and track frames of these sizes, and
// refuse larger frames.
#include "device/workspace.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <type_traits>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/random.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::core_test::device_workspace_test {
namespace {

/// A frame size, and the expected results for frames of this size.
template <int Width, int Height, int MinDots, int Limit_log2 = -30>
struct Size {
    static constexpr int kWidth_px = Width;
    static constexpr int kHeight_px = Height;
    /// Number of dots that a fix must exceed. The dots are 11 px apart.
    static constexpr int kMinDots = MinDots;
    /// log2 of the maximum probability of a wrong position. It is larger for the smallest frames
    /// because they have too few dots for the default maximum.
    static constexpr int kLimit_log2 = Limit_log2;
    using Memory = DeviceMemoryFor<Width, Height>;
};
using Sizes = testing::Types<Size<160, 120, 100, -24>, Size<188, 120, 130>, Size<320, 240, 480>>;

template <typename Frame>
Shot shot_of(std::uint64_t index) {
    Setup setup;
    setup.preset = Preset::nominal;
    setup.seed = 91;
    setup.camera.width_px = Frame::kWidth_px;
    setup.camera.height_px = Frame::kHeight_px;
    return draw_shot(setup, index);
}

/// Returns the distance between the position in a fix and the true position, in spacings.
double distance(const Fix& fix, const Shot& shot) {
    return std::hypot(std::remainder(fix.x_grid() - x_grid(shot.pose), double{kPositionsPerAxis}),
                      std::remainder(fix.y_grid() - y_grid(shot.pose), double{kPositionsPerAxis}));
}

template <typename Frame>
class DeviceWorkspace : public testing::Test {
  protected:
    Fix tracked(const GreyImage& image, const Prediction& prediction) {
        static_cast<void>(locator_.begin(image.width_px, image.height_px, prediction));
        for (int v = 0; v < image.height_px; ++v)
            locator_.push_row(image.view().row(v));
        return locator_.finish();
    }

    /// Returns a prediction moved by up to half a spacing, and rotated by up to 4 degrees.
    Prediction disturbed(const Fix& fix) {
        const double shift_q16 = 32768 * std::sqrt(rng_.uniform());
        const double direction_rad = rng_.uniform(-std::numbers::pi, std::numbers::pi);
        return moved(Prediction::like(fix), CodeVariant::anoto,
                     {static_cast<std::int32_t>(shift_q16 * std::cos(direction_rad)),
                      static_cast<std::int32_t>(shift_q16 * std::sin(direction_rad))},
                     static_cast<std::int32_t>(rng_.uniform(-4, 4) * 4294967296.0 / 360),
                     {(Frame::kWidth_px - 1) * 128, (Frame::kHeight_px - 1) * 128});
    }

    static DeviceOptions limited() {
        DeviceOptions options;
        options.integrity.max_p_wrong_log2 = Frame::kLimit_log2;
        return options;
    }

    std::unique_ptr<typename Frame::Memory> memory_ = std::make_unique<typename Frame::Memory>();
    DeviceLocator locator_{*memory_, limited()};
    Rng rng_{6};
};
TYPED_TEST_SUITE(DeviceWorkspace, Sizes);

TYPED_TEST(DeviceWorkspace, LocatesAndTracksFramesOfItsSize) {
    constexpr int kFrames = 60;
    int located = 0;
    int followed = 0;
    double squares = 0;
    double tracked_squares = 0;
    for (int i = 0; i < kFrames; ++i) {
        const Shot shot = shot_of<TypeParam>(static_cast<std::uint64_t>(i));
        const GreyImage image = render(shot);
        const Fix fix = this->locator_.locate(image.view());
        if (fix.status != Status::ok) continue;
        ++located;
        ASSERT_LT(distance(fix, shot), 0.1) << i;
        EXPECT_EQ(fix.section, shot.page.pattern.section);
        EXPECT_GT(fix.dots_used, TypeParam::kMinDots) << i;
        squares += std::pow(distance(fix, shot), 2);
        const Fix next = this->tracked(image, this->disturbed(fix));
        if (next.status != Status::ok) continue;
        ++followed;
        ASSERT_LT(distance(next, shot), 0.1) << i;
        EXPECT_EQ(next.attempt, Attempt::tracked);
        EXPECT_EQ(next.section, fix.section);
        EXPECT_GT(next.dots_used, 100) << i;
        // The centre of the plane is the centre of the frame, not of the tracked region.
        EXPECT_EQ(next.pattern_from_image.centre_q8.x, (TypeParam::kWidth_px - 1) * 128);
        EXPECT_EQ(next.pattern_from_image.centre_q8.y, (TypeParam::kHeight_px - 1) * 128);
        tracked_squares += std::pow(distance(next, shot), 2);
    }
    EXPECT_GE(located, kFrames - 1);
    EXPECT_GE(followed, TypeParam::kWidth_px == 160 ? 50 : kFrames - 2);
    // 0.004 spacings are 2 µm.
    EXPECT_LT(std::sqrt(squares / located), 0.004);
    EXPECT_LT(std::sqrt(tracked_squares / followed), 0.004);
    this->RecordProperty("error_grid", std::to_string(std::sqrt(squares / located)));
    this->RecordProperty("tracked_grid", std::to_string(std::sqrt(tracked_squares / followed)));
}

TYPED_TEST(DeviceWorkspace, GivesTheSameFromRowsAndImage) {
    const Shot shot = shot_of<TypeParam>(100);
    const GreyImage image = render(shot);
    const Fix whole = this->locator_.locate(image.view());
    ASSERT_EQ(this->locator_.begin(image.width_px, image.height_px), Status::ok);
    for (int v = 0; v < image.height_px; ++v)
        this->locator_.push_row(image.view().row(v));
    const Fix rows = this->locator_.finish();
    EXPECT_EQ(rows.status, Status::ok);
    EXPECT_EQ(rows.fraction_x_q16, whole.fraction_x_q16);
    EXPECT_EQ(rows.fraction_y_q16, whole.fraction_y_q16);
    EXPECT_EQ(rows.theta_bam, whole.theta_bam);
}

TYPED_TEST(DeviceWorkspace, RefusesLargerFrames) {
    constexpr int kWidth_px = TypeParam::kWidth_px;
    EXPECT_EQ(this->locator_.begin(kWidth_px + 1, 120), Status::image_too_large);
    EXPECT_EQ(this->locator_.begin(kWidth_px, 4097), Status::image_too_large);
    // A frame that is both wide and tall needs more bands of tiles than the workspace can hold.
    const int max_px = kWidth_px == 320 ? 240 : 4096;
    EXPECT_EQ(this->locator_.begin(kWidth_px, max_px), Status::ok);
    EXPECT_EQ(this->locator_.begin(kWidth_px, max_px + 1), Status::image_too_large);
    const Prediction prediction;
    EXPECT_EQ(this->locator_.begin(kWidth_px + 1, 120, prediction), Status::image_too_large);
}

TYPED_TEST(DeviceWorkspace, TakesAnyNoise) {
    Shot shot = shot_of<TypeParam>(0);
    GreyImage image = render(shot);
    const Fix fix = this->locator_.locate(image.view());
    for (int n = 0; n < 20; ++n) {
        // Fine and coarse noise fills the tables of runs, blobs and dots.
        const auto grain = static_cast<std::size_t>(1 + n % 5);
        std::uint8_t grey = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            if (i % grain == 0) grey = static_cast<std::uint8_t>(this->rng_.below(256));
            image.pixels[i] = grey;
        }
        EXPECT_NE(this->locator_.locate(image.view()).status, Status::ok) << n;
        EXPECT_NE(this->tracked(image, this->disturbed(fix)).status, Status::ok) << n;
    }
}

TEST(DeviceMemories, HaveTheSizesThatAreStated) {
    // The memory is larger on desktops because pointers are larger. `make budget` reports the size
    // on devices.
    EXPECT_LT(sizeof(DeviceMemoryFor<36, 36>), 5'000U);
    EXPECT_LT(sizeof(DeviceMemoryFor<160, 120>), 12'000U);
    EXPECT_LT(sizeof(DeviceMemoryFor<188, 120>), 13'400U);
    EXPECT_LT(sizeof(DeviceMemoryFor<320, 240>), 25'200U);
    EXPECT_TRUE((std::is_same_v<DeviceMemory, DeviceMemoryFor<188, 120>>));
}

}  // namespace
}  // namespace dotpose::core_test::device_workspace_test

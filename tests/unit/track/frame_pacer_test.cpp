#include "dotpose/frame_pacer.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace dotpose {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000;
constexpr std::int64_t kFrame_us = 20'000;  // frame period at 50 frames per second

Fix at(double x_grid, double y_grid = 50, double theta_deg = 0) {
    const auto q16 = [](double grid) { return static_cast<std::int64_t>(grid * 65536); };
    Fix fix;
    fix.status = Status::ok;
    fix.cell = {static_cast<std::uint32_t>(x_grid), static_cast<std::uint32_t>(y_grid)};
    fix.fraction_x_q16 = static_cast<std::uint16_t>(q16(x_grid) & 65535);
    fix.fraction_y_q16 = static_cast<std::uint16_t>(q16(y_grid) & 65535);
    fix.theta_bam =
        static_cast<std::int32_t>(static_cast<std::int64_t>(theta_deg / 180 * 2147483648.0));
    return fix;
}

Fix lost() {
    return {};
}

/// A device in simulated time. It takes a frame whenever the pacer requires one.
class Device {
  public:
    explicit Device(const PacerOptions& options = {}) : pacer_(options) {}

    /// Takes frames until `time_us`. `fix_at` returns the fix for a frame at a given time.
    template <typename FixAt>
    void run_until(std::int64_t time_us, FixAt fix_at) {
        while (next_us_ < time_us) {
            frames_us.push_back(next_us_);
            const std::int64_t wanted_us = pacer_.next_frame_us(fix_at(next_us_), next_us_);
            motions.push_back(pacer_.motion());
            next_us_ = std::max(wanted_us, next_us_ + kFrame_us);
        }
    }
    Motion motion() const { return pacer_.motion(); }

    std::vector<std::int64_t> frames_us;
    std::vector<Motion> motions;

  private:
    FramePacer pacer_;
    std::int64_t next_us_ = 0;
};

TEST(FramePacer, TakesEveryFrameOfAMovingDevice) {
    Device device;
    // The device moves at 0.2 mm per second. Its motion between two frames is below the threshold,
    // but its motion in 5 s exceeds the threshold.
    device.run_until(60 * kSecond_us,
                     [](std::int64_t t) { return at(100 + 0.4e-6 * static_cast<double>(t)); });
    EXPECT_EQ(device.frames_us.size(), 60U * 50);
    EXPECT_EQ(device.motion(), Motion::moving);
}

TEST(FramePacer, TakesAFrameASecondAfterFiveSecondsOfRest) {
    Device device;
    // The device is at rest, and the positions of its fixes have noise of 0.01 spacings.
    device.run_until(65 * kSecond_us, [](std::int64_t t) {
        return at(100 + (t / kFrame_us % 2 == 0 ? 0.01 : -0.01));
    });
    // Frames are taken every 20 ms from 0 s to 5 s, and then at 6 s, 7 s, ... 64 s.
    ASSERT_EQ(device.frames_us.size(), 251U + 59);
    EXPECT_EQ(device.frames_us[250], 5 * kSecond_us);
    EXPECT_EQ(device.motions[249], Motion::moving);
    EXPECT_EQ(device.motions[250], Motion::stationary);
    EXPECT_EQ(device.frames_us[251], 6 * kSecond_us);
    EXPECT_EQ(device.frames_us.back(), 64 * kSecond_us);
}

/// Changes the fix of a device at rest from `rest` to `after`, and expects that the device wakes if
/// and only if `wakes` is true. The fix changes at 10.5 s, so the frame at 11 s is the first with
/// the new fix.
void expect_wakes(const Fix& rest, const Fix& after, bool wakes, const PacerOptions& options = {}) {
    Device device(options);
    device.run_until(12 * kSecond_us,
                     [&](std::int64_t t) { return t < 10 * kSecond_us + 500'000 ? rest : after; });
    ASSERT_GE(device.frames_us.size(), 257U);
    EXPECT_EQ(device.frames_us[256], 11 * kSecond_us);
    EXPECT_EQ(device.motions[255], Motion::stationary);
    EXPECT_EQ(device.motions[256], wakes ? Motion::moving : Motion::stationary);
    EXPECT_EQ(device.frames_us.size(), wakes ? 256U + 50 : 257U);
}

TEST(FramePacer, WakesAtOnceWhenMoved) {
    expect_wakes(at(100), at(100.2), true);
    expect_wakes(at(100), at(99.8), true);
    expect_wakes(at(100), at(100, 50.2), true);
    expect_wakes(at(100), at(100, 50, 2), true);
    expect_wakes(at(100), at(4e8), true);
    expect_wakes(at(100), at(100.05, 50.05, 0.5), false);
    Fix other_section = at(100);
    other_section.section = {1, 0};
    expect_wakes(at(100), other_section, true);
}

TEST(FramePacer, AnglesMeetBehindHalfATurn) {
    expect_wakes(at(100, 50, 179.8), at(100, 50, -179.8), false);
    expect_wakes(at(100, 50, 179.2), at(100, 50, -179.2), true);
}

TEST(FramePacer, WakesWhenLostAndWhenFound) {
    expect_wakes(at(100), lost(), true);
    expect_wakes(at(100), lost(), false, {.lost_is_moved = false});
    expect_wakes(lost(), at(100), true);
    expect_wakes(lost(), lost(), false);
}

TEST(FramePacer, AMissedFrameIsNoMovement) {
    Device device;
    device.run_until(5 * kSecond_us + 1,
                     [](std::int64_t t) { return t / kFrame_us % 3 == 2 ? lost() : at(100); });
    EXPECT_EQ(device.motion(), Motion::stationary);
}

TEST(FramePacer, AddsUpWhatASlowDeviceCreeps) {
    Device device;
    // The device moves by one spacing per minute. From one frame to the next, it seems to be at
    // rest. In 6 s, however, it moves by a tenth of a spacing.
    device.run_until(600 * kSecond_us,
                     [](std::int64_t t) { return at(100 + static_cast<double>(t) / 60e6); });
    const auto moving = std::ranges::count(device.motions, Motion::moving);
    // The device takes 50 frames per second for 5 s out of every 7 s.
    EXPECT_GT(moving, 60 * 240);
    EXPECT_GT(std::ranges::count(device.motions, Motion::stationary), 60);
}

TEST(FramePacer, TakesItsThresholdsFromTheOptions) {
    Device device({.stationary_after_us = kSecond_us,
                   .stationary_period_us = 4 * kSecond_us,
                   .moving_period_us = 100'000,
                   .moved_q16 = 65536 * 2,
                   .turned_bam = 1 << 30});
    device.run_until(20 * kSecond_us, [](std::int64_t t) {
        return t < 10 * kSecond_us ? at(100, 50, 0) : at(101.5, 50, 80);
    });
    // Frames are taken at 0, 0.1, ... 1 s, then at 5, 9, 13, 17 s.
    ASSERT_EQ(device.frames_us.size(), 15U);
    EXPECT_EQ(device.frames_us[10], kSecond_us);
    EXPECT_EQ(device.frames_us[11], 5 * kSecond_us);
    EXPECT_EQ(device.motion(), Motion::stationary);
}

TEST(FramePacer, SurvivesAClockThatIsSetBack) {
    FramePacer pacer;
    EXPECT_EQ(pacer.next_frame_us(at(1), 100 * kSecond_us), 100 * kSecond_us);
    EXPECT_EQ(pacer.next_frame_us(at(1), 0), 0);
    EXPECT_EQ(pacer.next_frame_us(at(1), 5 * kSecond_us), 6 * kSecond_us);
    EXPECT_EQ(pacer.motion(), Motion::stationary);
}

}  // namespace
}  // namespace dotpose

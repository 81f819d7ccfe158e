// Tests that `locate` locates frames at the limits given in docs/limits.md.
#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../limit_frames.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/outcome.hpp"

namespace dotpose::test {
namespace {

constexpr std::uint64_t kSeed = 70;

/// Returns the number of test frames. It is smaller for large images, which take longer.
std::uint64_t frames_of(const CameraModel& camera) {
    constexpr int kSmall_px = 200 * 200;
    constexpr int kMedium_px = 1280 * 960;
    const int area_px = camera.width_px * camera.height_px;
    return area_px <= kSmall_px ? 6 : area_px < kMedium_px ? 5 : 1;
}

class Limits : public testing::TestWithParam<Limit> {};

TEST_P(Limits, AllFramesAreLocated) {
    const Limit& limit = GetParam();
    const auto memory = std::make_unique<LargeMemory>();
    for (std::uint64_t i = 0; i < frames_of(limit.camera); ++i) {
        const Shot shot = shot_at(limit, kSeed, i);
        const GreyImage image = picture_of(limit, shot);
        Outcome outcome;
        outcome.truth = truth_of(shot);
        outcome.fix = Locator(*memory, options_of(limit)).locate(image.view());
        EXPECT_EQ(outcome.fix.status, Status::ok)
            << limit.condition << ", seed " << kSeed << ", frame " << i << ": "
            << name(outcome.fix.status);
        EXPECT_FALSE(outcome.is_wrong()) << limit.condition << ", seed " << kSeed << ", frame " << i
                                         << ": 2^" << outcome.fix.p_wrong_log2;
    }
}

std::vector<Limit> held_limits() {
    std::vector<Limit> limits = all_limits();
    std::erase_if(limits, [](const Limit& limit) { return !limit.is_held; });
    return limits;
}

std::string test_name(const testing::TestParamInfo<Limit>& info) {
    std::string name = info.param.condition;
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Held, Limits, testing::ValuesIn(held_limits()), test_name);

TEST(MirroredFrames, AreRefusedAsSuch) {
    const auto memory = std::make_unique<LargeMemory>();
    for (std::uint64_t i = 0; i < 3; ++i) {
        dotpose::Setup setup;
        setup.seed = kSeed;
        const GreyImage image = render_scene(Scene::mirrored, draw_shot(setup, i));
        EXPECT_EQ(Locator(*memory, DeviceOptions{}).locate(image.view()).status, Status::mirrored)
            << "seed " << kSeed << ", frame " << i;
    }
}

}  // namespace
}  // namespace dotpose::test

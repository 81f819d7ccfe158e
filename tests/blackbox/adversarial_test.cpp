// Frames meant to deceive: a fix is the true pose, or there is none. `dotpose_adversarial` runs as
// many as one likes.
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "../adversarial_frames.hpp"
#include "dotpose/locate.hpp"

namespace dotpose {
namespace {

using test::Adversary;

class Adversarial : public testing::TestWithParam<Adversary> {};

TEST_P(Adversarial, FramesGiveNoWrongFix) {
    constexpr std::uint64_t kSeed = 7;
    constexpr std::uint64_t kFrames = 24;
    const auto workspace = std::make_unique<LargeWorkspace>();
    for (std::uint64_t index = 0; index < kFrames; ++index) {
        const test::AdversarialFrame frame = test::make_adversarial(GetParam(), kSeed, index);
        const Fix fix = locate(frame.image.view(), frame.options, *workspace);
        EXPECT_NE(test::judge(fix, frame), test::Verdict::wrong)
            << "index " << index << ", seed " << kSeed << ": cell " << fix.cell.x << ", "
            << fix.cell.y << ", 2^" << fix.p_wrong_log2;
    }
}

INSTANTIATE_TEST_SUITE_P(Classes, Adversarial, testing::ValuesIn(test::kAdversaries),
                         [](const testing::TestParamInfo<Adversary>& adversary) {
                             std::string title(test::name(adversary.param));
                             std::replace(title.begin(), title.end(), ' ', '_');
                             return title;
                         });

}  // namespace
}  // namespace dotpose

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

class AdversarialClass : public testing::TestWithParam<Adversary> {};

TEST_P(AdversarialClass, FramesGiveNoWrongFix) {
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

// Two patterns in the same direction, 0.22 spacings apart: the columns of one and the rows of the
// other were once taken for a position.
TEST(Adversarial, ColumnsAndRowsAreOfOnePattern) {
    const auto workspace = std::make_unique<LargeWorkspace>();
    const test::AdversarialFrame frame = test::make_adversarial(Adversary::overlay, 7001, 3375);
    const Fix fix = locate(frame.image.view(), frame.options, *workspace);
    EXPECT_NE(test::judge(fix, frame), test::Verdict::wrong);
}

INSTANTIATE_TEST_SUITE_P(Classes, AdversarialClass, testing::ValuesIn(test::kAdversaries),
                         [](const testing::TestParamInfo<Adversary>& adversary) {
                             std::string title(test::name(adversary.param));
                             std::replace(title.begin(), title.end(), ' ', '_');
                             return title;
                         });

}  // namespace
}  // namespace dotpose

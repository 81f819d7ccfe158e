// Tests `locate` with frames that are designed to deceive it. Every fix must agree with the true
// pose. `dotpose_tables adversarial` tests a larger number of such frames.
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
    const auto memory = std::make_unique<LargeMemory>();
    for (std::uint64_t index = 0; index < kFrames; ++index) {
        const test::AdversarialFrame frame = test::make_adversarial(GetParam(), kSeed, index);
        const Fix fix = Locator(*memory, frame.options).locate(frame.image.view());
        EXPECT_NE(test::judge(fix, frame), test::Verdict::wrong)
            << "index " << index << ", seed " << kSeed << ": cell " << fix.cell.x << ", "
            << fix.cell.y << ", 2^" << fix.p_wrong_log2;
    }
}

// Each of these frames shows two patterns with the same orientation, whose grids are shifted by
// about a fifth of the spacing. Regression: `locate` read the columns of one pattern and the rows
// of the other pattern, and reported the position that this combination encodes.
TEST(Adversarial, ColumnsAndRowsAreOfOnePattern) {
    const auto memory = std::make_unique<LargeMemory>();
    struct Overlay {
        std::uint64_t seed;
        std::uint64_t index;
    };
    for (const Overlay& overlay : {Overlay{7001, 3375},
                                   {31018, 255},
                                   {33112, 148},
                                   {33112, 1705},
                                   {44002, 10287},
                                   {45001, 34719}}) {
        const test::AdversarialFrame frame =
            test::make_adversarial(Adversary::overlay, overlay.seed, overlay.index);
        const Fix fix = Locator(*memory, frame.options).locate(frame.image.view());
        EXPECT_NE(test::judge(fix, frame), test::Verdict::wrong)
            << "index " << overlay.index << ", seed " << overlay.seed;
    }
}

// Each of these frames shows a seam between two sections. The digits computed from lines on
// opposite sides of the seam belong to neither section, but occur elsewhere in the code.
// Regression: `locate` reported the position where they occur.
TEST(Adversarial, WhatASeamExplainsBetterIsNoFix) {
    const auto memory = std::make_unique<LargeMemory>();
    struct Seam {
        std::uint64_t seed;
        std::uint64_t index;
    };
    for (const Seam& seam : {Seam{11007, 1674}, {11009, 89}, {11016, 1875}, {11019, 578}}) {
        const test::AdversarialFrame frame =
            test::make_adversarial(Adversary::seam, seam.seed, seam.index);
        for (const Effort effort : {Effort::device, Effort::once, Effort::twice}) {
            DeviceOptions options = frame.options;
            options.effort = effort;
            const Fix fix = Locator(*memory, options).locate(frame.image.view());
            EXPECT_NE(test::judge(fix, frame), test::Verdict::wrong)
                << "index " << seam.index << ", seed " << seam.seed;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Classes, AdversarialClass, testing::ValuesIn(test::kAdversaries),
                         [](const testing::TestParamInfo<Adversary>& adversary) {
                             std::string title(test::name(adversary.param));
                             std::replace(title.begin(), title.end(), ' ', '_');
                             return title;
                         });

}  // namespace
}  // namespace dotpose

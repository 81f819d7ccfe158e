// Tests locating frames in an unknown code variant. The fixes must be the same as those found if
// the code variant is given.
#include <memory>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

class AnyCodeTest : public testing::Test {
  protected:
    static dotpose::Setup setup_of(Preset preset) {
        dotpose::Setup setup;
        setup.preset = preset;
        setup.seed = 41;
        return setup;
    }
    std::unique_ptr<LargeMemory> memory_ = std::make_unique<LargeMemory>();
};

void expect_equal(const Fix& a, const Fix& b) {
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.attempt, b.attempt);
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.section, b.section);
    EXPECT_EQ(a.fraction_x_q16, b.fraction_x_q16);
    EXPECT_EQ(a.fraction_y_q16, b.fraction_y_q16);
    EXPECT_EQ(a.theta_bam, b.theta_bam);
    EXPECT_EQ(a.bit_errors, b.bit_errors);
    EXPECT_EQ(a.dots_used, b.dots_used);
    EXPECT_EQ(a.p_wrong_log2, b.p_wrong_log2);
}

TEST_F(AnyCodeTest, GivenAProfileAllIsAsItWas) {
    for (const Preset preset : {Preset::nominal, Preset::hard}) {
        for (std::uint64_t i = 0; i < 12; ++i) {
            SCOPED_TRACE(i);
            const GreyImage image = render(draw_shot(setup_of(preset), i));
            // Fills the memory with data from another call, which must have no effect.
            static_cast<void>(
                Locator(*memory_, DeviceOptions{}).locate_in_any_code(image.view(), {}));
            const Fix fix = Locator(*memory_, DeviceOptions{}).locate_in_code(image.view()).fix;
            expect_equal(fix, Locator(*memory_, DeviceOptions{}).locate(image.view()));
        }
    }
}

TEST_F(AnyCodeTest, OnceTheProfileIsKnownNothingIsLost) {
    CodeEvidence evidence;
    for (std::uint32_t i = 0; i < 4; ++i)
        evidence.add({1000 * i, 0}, {0, -256 * 30, -256 * 30});
    for (const Preset preset : {Preset::nominal, Preset::hard}) {
        for (std::uint64_t i = 20; i < 32; ++i) {
            SCOPED_TRACE(i);
            const GreyImage image = render(draw_shot(setup_of(preset), i));
            const Fix fix = Locator(*memory_, DeviceOptions{}).locate(image.view());
            const CodeReading reading =
                Locator(*memory_, DeviceOptions{}).locate_in_any_code(image.view(), evidence);
            EXPECT_EQ(reading.fix.status, fix.status);
            EXPECT_EQ(reading.fix.cell, fix.cell);
            EXPECT_EQ(reading.code, CodeVariant::anoto);
        }
    }
}

TEST_F(AnyCodeTest, FramesThatBothProfilesExplainSayNothing) {
    CodeEvidence evidence;
    for (std::uint32_t i = 0; i < 40; ++i) {
        Shot shot = draw_shot(setup_of(Preset::nominal), i);
        // The place is in the middle of a region in which anoto and libdots have the same bits.
        shot.pose.cell = {241 * (1000 + i) + 100, 241 * 2000 + 100};
        const CodeReading reading =
            Locator(*memory_, DeviceOptions{}).locate_in_any_code(render(shot).view(), evidence);
        ASSERT_EQ(reading.fix.status, Status::ok);
        evidence = reading.evidence;
    }
    EXPECT_EQ(evidence.log2_q8(CodeVariant::anoto), evidence.log2_q8(CodeVariant::libdots));
    EXPECT_LT(evidence.log2_q8(CodeVariant::microdots), -30 * 256);
}

TEST_F(AnyCodeTest, RefusesWhatLocateRefuses) {
    DeviceOptions options;
    options.threshold.low_q8 = 0;
    const GreyImage image = render(draw_shot(setup_of(Preset::nominal), 0));
    EXPECT_EQ(Locator(*memory_, options).locate_in_any_code(image.view(), {}).fix.status,
              Status::bad_argument);
    EXPECT_EQ(Locator(*memory_, DeviceOptions{})
                  .locate_in_any_code({nullptr, 188, 120, 188}, {})
                  .fix.status,
              Status::bad_argument);
}

}  // namespace
}  // namespace dotpose

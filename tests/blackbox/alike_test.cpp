// Tests frames in which all dots have the same sub-pixel phase. The error of a centroid depends on
// the phase, so in these frames the errors do not average out.
#include <cstdint>
#include <memory>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "../alike_frames.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/score.hpp"

namespace dotpose::test {
namespace {

constexpr std::uint64_t kSeed = 223;
constexpr int kFramesOfCase = 60;

struct AlikeCase {
    AlikeDots dots;
    double max_median_px;  ///< maximum allowed median of the position errors
};

void PrintTo(const AlikeCase& of, std::ostream* out) {
    *out << of.dots.spacing_px << " px, " << of.dots.angle_deg << " degrees, dots of "
         << of.dots.dot << ", blur " << of.dots.blur_px << " px";
}

class DotsAlike : public testing::TestWithParam<AlikeCase> {};

TEST_P(DotsAlike, ErrorsAreAsLargeAsTheyAreSaidToBe) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed);
    const auto memory = std::make_unique<LargeMemory>();
    DeviceOptions options;
    options.effort = Effort::once;
    std::vector<Outcome> outcomes(kFramesOfCase);
    for (int i = 0; i < kFramesOfCase; ++i) {
        const Shot shot = shot_of(GetParam().dots, kSeed, i);
        const GreyImage image = render(shot);
        Outcome& outcome = outcomes[static_cast<std::size_t>(i)];
        outcome.truth = truth_of(shot);
        outcome.fix = Locator(*memory, options).locate(image.view());
    }
    const Score score = score_of(outcomes);
    EXPECT_EQ(score.wrong, 0);
    EXPECT_GE(score.located, kFramesOfCase * 9 / 10);
    // If the reported variances are correct, the mean of kFramesOfCase squared errors, each divided
    // by its variance, exceeds 1.85 with a probability of only 1/20,000.
    for (const double normalised : score.normalised)
        EXPECT_LT(normalised, 1.85);
    const double px = kDefaultSpacing_mm / GetParam().dots.spacing_px;
    EXPECT_LT(score.position_um.median / 1000 / px, GetParam().max_median_px);
}

INSTANTIATE_TEST_SUITE_P(
    Spacings, DotsAlike,
    testing::Values(AlikeCase{{.spacing_px = 8, .blur_px = 0.7, .angle_deg = 0}, 0.006},
                    AlikeCase{{.spacing_px = 10, .blur_px = 0.7, .angle_deg = 90}, 0.006},
                    AlikeCase{{.spacing_px = 11, .blur_px = 0.7, .angle_deg = 0}, 0.006},
                    AlikeCase{{.spacing_px = 11, .blur_px = 0.7, .angle_deg = 45}, 0.006},
                    AlikeCase{{.spacing_px = 12, .blur_px = 0.7, .angle_deg = 0}, 0.006},
                    AlikeCase{{.spacing_px = 12, .blur_px = 0.7, .angle_deg = 90}, 0.006}));

// The edges of these dots are sharper than a pixel, so the pixel bias is large. Without its
// correction, the median error at 12 px per spacing would be 0.0100 px, far above the limit.
INSTANTIATE_TEST_SUITE_P(
    HardlyBlurred, DotsAlike,
    testing::Values(AlikeCase{{.spacing_px = 8, .blur_px = 0.3, .angle_deg = 0}, 0.004},
                    AlikeCase{{.spacing_px = 11, .blur_px = 0.3, .angle_deg = 90}, 0.0035},
                    AlikeCase{{.spacing_px = 12, .blur_px = 0.3, .angle_deg = 0}, 0.0035},
                    AlikeCase{{.spacing_px = 12, .blur_px = 0.3, .angle_deg = 90}, 0.0035}));

// Only one or two pixels of each dot are darker than the threshold. If the centroid were computed
// from these pixels only, the error would be 0.030 px, and the mean squared error would be more
// than twice the reported variance.
INSTANTIATE_TEST_SUITE_P(
    Pale, DotsAlike,
    testing::Values(AlikeCase{{.spacing_px = 8, .dot = 0.1, .blur_px = 1, .angle_deg = 0}, 0.024},
                    AlikeCase{{.spacing_px = 8, .dot = 0.1, .blur_px = 1, .angle_deg = 90},
                              0.024}));

// The centroid windows of these dots are larger than the image of the model dot. Regression: pixels
// outside this image were added, so the squared errors were 12 to 22 times as large as the
// variance.
INSTANTIATE_TEST_SUITE_P(LargerThanTheModel, DotsAlike,
                         testing::Values(AlikeCase{
                             {.spacing_px = 24, .dot = 0.35, .blur_px = 1, .angle_deg = 0},
                             0.0015}));

}  // namespace
}  // namespace dotpose::test

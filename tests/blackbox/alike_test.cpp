// Dots that all fall on the pixels alike: nothing averages out what a centre depends on that.
#include <cstdint>
#include <memory>
#include <numbers>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/score.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/tools/truth.hpp"

namespace dotpose::test {
namespace {

constexpr std::uint64_t kSeed = 223;
constexpr int kFrames = 60;

struct Alike {
    int spacing_px;
    double angle_deg;
    double blur_px;
    double most_px;        ///< median error
    double dot = 1.0 / 6;  ///< diameter, spacings
};

void PrintTo(const Alike& alike, std::ostream* out) {
    *out << alike.spacing_px << " px, " << alike.angle_deg << " degrees, dots of " << alike.dot
         << ", blur " << alike.blur_px << " px";
}

Shot shot_of(const Alike& alike, int index) {
    Setup setup;
    setup.camera.mm_per_px = kDefaultSpacing_mm / alike.spacing_px;
    setup.seed = kSeed;
    Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
    shot.pose.theta_rad = alike.angle_deg * std::numbers::pi / 180;
    shot.imperfections = {};
    shot.imperfections.noise_sigma = 3;
    shot.imperfections.blur_sigma_px = alike.blur_px;
    shot.imperfections.sub_pixels = 8;
    shot.page.pattern.dot_mm = alike.dot * kDefaultSpacing_mm;
    return shot;
}

class DotsAlike : public testing::TestWithParam<Alike> {};

TEST_P(DotsAlike, ErrorsAreAsLargeAsTheyAreSaidToBe) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed);
    const auto memory = std::make_unique<LargeMemory>();
    Options options;
    options.effort = Effort::once;
    std::vector<Outcome> outcomes(kFrames);
    for (int i = 0; i < kFrames; ++i) {
        const Shot shot = shot_of(GetParam(), i);
        const GreyImage image = render(shot);
        Outcome& outcome = outcomes[static_cast<std::size_t>(i)];
        outcome.truth = truth_of(shot);
        outcome.fix = Locator(*memory, options).locate(image.view());
    }
    const Score score = score_of(outcomes);
    EXPECT_EQ(score.wrong, 0);
    EXPECT_GE(score.located, kFrames * 9 / 10);
    // Means of so many squares of a normal distribution of deviation 1 lie below this but for one
    // in 20,000.
    for (const double normalised : score.normalised)
        EXPECT_LT(normalised, 1.85);
    const double px = kDefaultSpacing_mm / GetParam().spacing_px;
    EXPECT_LT(score.position_um.median / 1000 / px, GetParam().most_px);
}

INSTANTIATE_TEST_SUITE_P(Spacings, DotsAlike,
                         testing::Values(Alike{8, 0, 0.7, 0.006}, Alike{10, 90, 0.7, 0.006},
                                         Alike{11, 0, 0.7, 0.006}, Alike{11, 45, 0.7, 0.006},
                                         Alike{12, 0, 0.7, 0.006}, Alike{12, 90, 0.7, 0.006}));

// Dots with details finer than pixels: 0.0100 px at 12 px per spacing if their bias is left.
INSTANTIATE_TEST_SUITE_P(HardlyBlurred, DotsAlike,
                         testing::Values(Alike{8, 0, 0.3, 0.004}, Alike{11, 90, 0.3, 0.0035},
                                         Alike{12, 0, 0.3, 0.0035}, Alike{12, 90, 0.3, 0.0035}));

// Dots hardly darker than noise, of which a threshold leaves a pixel or two: 0.030 px, and more
// than two variances, if only centres near those pixels are trusted.
INSTANTIATE_TEST_SUITE_P(Pale, DotsAlike,
                         testing::Values(Alike{8, 0, 1, 0.024, 0.1}, Alike{8, 90, 1, 0.024, 0.1}));

}  // namespace
}  // namespace dotpose::test

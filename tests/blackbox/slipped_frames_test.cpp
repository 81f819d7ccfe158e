// Tests fixes on sheets that are not planar, with `Locator` and with the tool.
#include "../slipped_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "../seam_frames.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/outcome.hpp"
#include "locate_command.hpp"

namespace dotpose::test {
namespace {

constexpr std::uint64_t kSeed = 229;

Shot nominal_shot(std::uint64_t index) {
    Setup setup;
    setup.seed = kSeed;
    return draw_shot(setup, index);
}

/// Returns the largest of the errors of x, y and theta, each in units of its reported standard
/// deviation.
double sigmas_off(const Fix& fix, const Truth& truth) {
    const Deviation off = deviation_of(fix, truth);
    const double errors[] = {off.x_grid, off.y_grid, off.theta_rad};
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i)
        most = std::max(most, std::abs(errors[i]) / std::sqrt(double{fix.covariance[i][i]}));
    return most;
}

double sigmas_off(const Fix& fix, const Shot& shot) {
    return sigmas_off(fix, truth_of(shot));
}

// Regression: small steps in the middle of the view were not detected, so only 97.6 % of the
// errors were within 4 reported standard deviations. Now 99.8 % are.
TEST(SeamedSheet, ErrorsAreAsLargeAsTheyAreSaidToBe) {
    constexpr int kFrames = 400;
    constexpr double kAnywhere_px = std::numeric_limits<double>::infinity();
    const auto memory = std::make_unique<LargeMemory>();
    int fixes = 0;
    int claim_too_much = 0;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        const SeamShot shot = draw_seam_shot(188, 120, kAnywhere_px, kSeed, i);
        const GreyImage image = render(shot);
        const Fix fix = Locator(*memory, DeviceOptions{}).locate(image.view());
        if (fix.status != Status::ok) continue;
        ++fixes;
        claim_too_much += sigmas_off(fix, shot.truth()) > 4 ? 1 : 0;
    }
    EXPECT_GE(fixes, kFrames * 8 / 10);
    EXPECT_LE(claim_too_much, fixes / 100);
}

TEST(SlippedSheet, ErrorsAreAsLargeAsTheyAreSaidToBe) {
    constexpr int kFrames = 150;
    const auto memory = std::make_unique<LargeMemory>();
    int fixes = 0;
    int claim_too_much = 0;
    int divided = 0;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", frame " << i);
        Shot shot = nominal_shot(i);
        apply(draw_slip(shot), shot);
        const GreyImage image = render(shot);
        Outcome outcome;
        outcome.truth = truth_of(shot);
        outcome.fix = Locator(*memory, DeviceOptions{}).locate(image.view());
        if (!outcome.is_fix()) continue;
        ++fixes;
        EXPECT_FALSE(outcome.is_wrong());
        claim_too_much += sigmas_off(outcome.fix, shot) > 4 ? 1 : 0;
        divided += outcome.fix.surface == Surface::divided ? 1 : 0;
    }
    EXPECT_GE(fixes, kFrames * 9 / 10);
    // At most 3 % of the fixes may be off by more than 4 standard deviations. The limit is this
    // high because there are only a few frames: if the true fraction is 1 %, one run in 70 still
    // exceeds 3 %.
    EXPECT_LE(claim_too_much, fixes * 3 / 100);
    // Only half of the steps need to be detected, because the other steps affect only a corner of
    // the view or are smaller than the scatter of the dots.
    EXPECT_GE(divided, fixes / 2);
}

/// Statistics of the position errors on one kind of sheet, relative to the reported covariances.
struct Claims {
    int fixes = 0;
    int within_4_sigmas = 0;
    /// Mean of the squared errors of x, each divided by the variance that the fix reports.
    double mean_square = 0;

    explicit Claims(double wrinkled_by) {
        constexpr int kFrames = 150;
        const auto memory = std::make_unique<LargeMemory>();
        for (std::uint64_t i = 0; i < kFrames; ++i) {
            Shot shot = nominal_shot(i);
            if (wrinkled_by > 0) wrinkle(wrinkled_by, shot);
            const Fix fix = Locator(*memory, DeviceOptions{}).locate(render(shot).view());
            if (fix.status != Status::ok) continue;
            ++fixes;
            within_4_sigmas += sigmas_off(fix, shot) <= 4 ? 1 : 0;
            const double off = deviation_of(fix, truth_of(shot)).x_grid;
            mean_square += off * off / double{fix.covariance[0][0]};
        }
        mean_square /= std::max(fixes, 1);
    }
};

// A view of 9 x 6 mm is too small to show wrinkles with wavelengths of 8 mm and more, so the
// covariance must allow for wrinkles that are not visible. Regression: only 62 % (slight wrinkles)
// and 72 % (stronger wrinkles) of the errors were within 4 reported standard deviations.
TEST(WrinkledSheet, MostErrorsAreAsLargeAsTheyAreSaidToBe) {
    const Claims slightly(0.02);
    EXPECT_EQ(slightly.fixes, 150);
    EXPECT_GE(slightly.within_4_sigmas, 110);
    const Claims more(0.05);
    EXPECT_GE(more.fixes, 145);
    EXPECT_GE(more.within_4_sigmas, more.fixes * 88 / 100);
}

TEST(WrinkledSheet, DoesNotMakeFlatOnesLookInexact) {
    const Claims flat(0);
    EXPECT_EQ(flat.fixes, 150);
    EXPECT_EQ(flat.within_4_sigmas, 150);
    EXPECT_GT(flat.mean_square, 0.75);
    EXPECT_LT(flat.mean_square, 1.25);
}

/// Returns a shot in which one third of the view is displaced by a fifth of the spacing.
Shot slipped_shot() {
    Shot shot = nominal_shot(0);
    apply({half_extent_grid(shot, 1) / 3, 1, {0.2, -0.05}, 0.005}, shot);
    return shot;
}

TEST(SlippedSheet, PredictionsAreNoHelpToTheOtherSide) {
    const auto memory = std::make_unique<LargeMemory>();
    const Shot shot = slipped_shot();
    const GreyImage image = render(shot);
    const Fix fix = Locator(*memory, DeviceOptions{}).locate(image.view());
    ASSERT_EQ(fix.status, Status::ok);
    const Fix tracked =
        Locator(*memory, DeviceOptions{}).locate(image.view(), Prediction::like(fix));
    ASSERT_EQ(tracked.status, Status::ok);
    EXPECT_EQ(tracked.attempt, Attempt::tracked);
    EXPECT_EQ(tracked.surface, Surface::divided);
    EXPECT_LT(sigmas_off(tracked, shot), 4);
}

// Blurred dots have low contrast, so a brightness gradient in the background causes a comparatively
// large bias of their centroids.
TEST(BlurredFrames, ErrorsAreAsLargeAsTheyAreSaidToBe) {
    constexpr int kFrames = 150;
    const auto memory = std::make_unique<LargeMemory>();
    int fixes = 0;
    double x = 0;
    double y = 0;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
        Shot shot = nominal_shot(i);
        shot.imperfections.blur_sigma_px = 1.75;
        shot.imperfections.jitter_mm = 0;
        const Fix fix = Locator(*memory, DeviceOptions{}).locate(render(shot).view());
        if (fix.status != Status::ok) continue;
        ++fixes;
        const Deviation off = deviation_of(fix, truth_of(shot));
        x += off.x_grid * off.x_grid / double{fix.covariance[0][0]};
        y += off.y_grid * off.y_grid / double{fix.covariance[1][1]};
    }
    EXPECT_EQ(fixes, kFrames);
    // The mean of 150 squared standard normal variables is 1, with a standard deviation of 0.12.
    // The limit is 4 standard deviations above the mean.
    EXPECT_LT(x / fixes, 1.5);
    EXPECT_LT(y / fixes, 1.5);
}

class SlippedSheetCommand : public LocateCommand {};

TEST_F(SlippedSheetCommand, TheToolSaysWhichSurfaceItSaw) {
    write_pgm(directory_ / "even.pgm", render(nominal_shot(0)).view());
    write_pgm(directory_ / "slipped.pgm", render(slipped_shot()).view());
    run("even.pgm slipped.pgm");
    const std::vector<json> found = records();
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0]["surface"], "even");
    EXPECT_EQ(found[1]["surface"], "divided");
    EXPECT_LT(found[1]["dots_used"], found[0]["dots_used"]);
}

}  // namespace
}  // namespace dotpose::test

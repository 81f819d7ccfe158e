#include "dotpose/tools/score.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/evaluate.hpp"

namespace dotpose {
namespace {

constexpr double kBamPerDegree = 2147483648.0 / 180;

/// Returns an outcome whose fix has the given errors. The true pose is (1000.25, 2000.5) in section
/// (3, 4), with an angle of 10 degrees.
Outcome outcome(double dx_q16 = 0, double dy_q16 = 0, double dtheta_deg = 0) {
    Outcome outcome;
    outcome.truth = {true, 1000.25, 2000.5, 10 * std::numbers::pi / 180, Section{3, 4}, 0.5};
    Fix& fix = outcome.fix;
    fix.status = Status::ok;
    fix.cell = {1000, 2000};
    fix.fraction_x_q16 = static_cast<std::uint16_t>(16384 + dx_q16);
    fix.fraction_y_q16 = static_cast<std::uint16_t>(32768 + dy_q16);
    fix.theta_bam = static_cast<std::int32_t>(std::lround((10 + dtheta_deg) * kBamPerDegree));
    fix.section = {3, 4};
    fix.p_wrong_log2 = -40;
    for (int i = 0; i < 3; ++i)
        fix.covariance[i][i] = 1e-4F;
    outcome.elapsed_us = 10;
    return outcome;
}

Outcome failure(Status status) {
    Outcome outcome;
    outcome.fix.status = status;
    outcome.elapsed_us = 30;
    return outcome;
}

TEST(Quantiles, AreNearestRanks) {
    const Quantiles ten = quantiles_of({10, 9, 8, 7, 6, 5, 4, 3, 2, 1});
    EXPECT_EQ(ten.median, 5);  // rank 5
    EXPECT_EQ(ten.p95, 10);    // rank ceil(9.5)
    EXPECT_EQ(ten.max, 10);
    std::vector<double> twenty(20);
    for (std::size_t i = 0; i < twenty.size(); ++i)
        twenty[i] = static_cast<double>(i + 1);
    EXPECT_EQ(quantiles_of(twenty).p95, 19);
    EXPECT_EQ(quantiles_of({7}).median, 7);
    EXPECT_EQ(quantiles_of({7}).p95, 7);
    EXPECT_TRUE(std::isnan(quantiles_of({}).median));
}

TEST(Score, IsWhatAHandComputes) {
    // The first distance is 0.025 spacings (12.5 µm), the hypotenuse of 0.015 and 0.020 spacings.
    // The second distance is zero.
    const std::vector<Outcome> outcomes = {outcome(0.015 * 65536, 0.020 * 65536, 0.5), outcome(),
                                           failure(Status::no_grid), failure(Status::no_grid)};
    const Score score = score_of(outcomes);
    EXPECT_EQ(score.frames, 4);
    EXPECT_EQ(score.located, 2);
    EXPECT_EQ(score.wrong, 0);
    EXPECT_EQ(score.located_fraction(), 0.5);
    EXPECT_EQ(score.by_status[static_cast<std::size_t>(Status::no_grid)], 2);
    EXPECT_EQ(score.by_status[static_cast<std::size_t>(Status::ok)], 2);
    EXPECT_NEAR(score.position_um.max, 12.5, 0.01);
    EXPECT_NEAR(score.position_um.median, 0, 1e-6);
    EXPECT_NEAR(score.angle_deg.max, 0.5, 1e-6);
    EXPECT_NEAR(score.normalised[0], 0.015 * 0.015 / 1e-4 / 2, 0.01);
    EXPECT_NEAR(score.normalised[1], 0.020 * 0.020 / 1e-4 / 2, 0.01);
    EXPECT_NEAR(score.normalised[2], std::pow(0.5 * std::numbers::pi / 180, 2) / 1e-4 / 2, 1e-4);
    EXPECT_EQ(score.largest_p_wrong, std::ldexp(1, -40));
    EXPECT_EQ(score.elapsed_us.median, 10);
    EXPECT_EQ(score.elapsed_us.max, 30);
}

TEST(Score, WrongFixesAreCountedAndKeptOutOfTheErrors) {
    Outcome far = outcome();
    far.fix.cell.x += 1;
    Outcome turned = outcome(0, 0, 2.1);
    Outcome elsewhere = outcome();
    elsewhere.fix.section.v = 5;
    Outcome of_unknown_section = elsewhere;
    of_unknown_section.truth.section.reset();
    Outcome of_nothing = outcome();
    of_nothing.truth.has_pose = false;
    EXPECT_TRUE(far.is_wrong());
    EXPECT_TRUE(turned.is_wrong());
    EXPECT_TRUE(elsewhere.is_wrong());
    EXPECT_FALSE(of_unknown_section.is_wrong());
    EXPECT_TRUE(of_nothing.is_wrong());
    EXPECT_FALSE(outcome(0.49 * 65536, 0, 1.9).is_wrong());
    EXPECT_FALSE(failure(Status::no_grid).is_wrong());

    const Score score = score_of(std::vector<Outcome>{far, turned, elsewhere, outcome()});
    EXPECT_EQ(score.wrong, 3);
    EXPECT_EQ(score.located, 1);
    EXPECT_NEAR(score.position_um.max, 0, 1e-6);
    EXPECT_NEAR(score.angle_deg.max, 0, 1e-6);
}

TEST(Score, AnglesAreComparedAcrossHalfATurn) {
    Outcome outcome_at_pi = outcome();
    outcome_at_pi.truth.theta_rad = std::numbers::pi;
    outcome_at_pi.fix.theta_bam = -2147483647 - 1;
    EXPECT_NEAR(deviation_of(outcome_at_pi.fix, outcome_at_pi.truth).theta_rad, 0, 1e-9);
    EXPECT_FALSE(outcome_at_pi.is_wrong());
}

TEST(Score, UnreadableFilesAreNoFrames) {
    Outcome unreadable;
    unreadable.problem = "no such file";
    const Score score = score_of(std::vector<Outcome>{unreadable, outcome()});
    EXPECT_EQ(score.frames, 1);
    EXPECT_EQ(score.unreadable, 1);
    EXPECT_EQ(score.located_fraction(), 1);
}

TEST(Score, OfNothingIsShownWithoutNumbers) {
    for (const auto& [what, value] : described(score_of({})))
        EXPECT_EQ(value.find("nan"), std::string::npos) << what;
}

TEST(Evaluate, ResultsDoNotDependOnTheNumberOfThreads) {
    FrameRun run;
    run.frames = 12;
    dotpose::Setup setup;
    setup.preset = Preset::hard;
    run.frame_at = frames_of_setup(setup);
    run.options.resize(2);
    run.options[1].decoder = Decoder::window;
    run.threads = 1;
    const auto alone = evaluate(run);
    run.threads = 5;
    const auto together = evaluate(run);
    ASSERT_EQ(alone.size(), 2u);
    for (std::size_t k = 0; k < alone.size(); ++k) {
        ASSERT_EQ(alone[k].size(), 12u);
        for (std::size_t i = 0; i < alone[k].size(); ++i) {
            EXPECT_EQ(alone[k][i].fix.status, together[k][i].fix.status);
            EXPECT_EQ(alone[k][i].fix.x_grid(), together[k][i].fix.x_grid());
            EXPECT_EQ(alone[k][i].truth.x_grid, together[k][i].truth.x_grid);
        }
    }
}

TEST(Evaluate, ErrorsOfAFrameAndGivingUpReachTheCaller) {
    FrameRun run;
    run.frames = 3;
    run.frame_at = [](int) -> KnownFrame { throw BadArgument("no such frame"); };
    EXPECT_THROW(evaluate(run), BadArgument);
    run.frame_at = frames_of_setup({});
    run.threads = 1;
    int told = 0;
    run.progress = [&told](int, int) { return ++told < 2; };
    EXPECT_THROW(evaluate(run), Error);
    EXPECT_EQ(told, 2);
}

}  // namespace
}  // namespace dotpose

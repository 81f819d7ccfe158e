#include "evaluate/protocol.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../xml_check.hpp"
#include "dotpose/tools/draw.hpp"
#include "evaluate/plot.hpp"
#include "evaluate/sweep.hpp"

namespace dotpose::evaluate_detail {
namespace {

TEST(Spiral, GoesFromTheMiddleOutwards) {
    const std::vector<Step> steps = spiral(3);
    const std::vector<Step> expected = {{0, 0},  {1, 0},   {1, 1},  {0, 1}, {-1, 1},
                                        {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    EXPECT_EQ(steps, expected);
    EXPECT_EQ(spiral(1).size(), 1u);
    EXPECT_THROW(spiral(4), BadArgument);
}

TEST(Spiral, VisitsEveryPositionOnceByNeighbouringSteps) {
    const std::vector<Step> steps = spiral(kPositionsPerSide);
    ASSERT_EQ(steps.size(), 121u);
    std::set<std::pair<int, int>> seen;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        EXPECT_LE(std::max(std::abs(steps[i].x), std::abs(steps[i].y)), 5);
        seen.insert({steps[i].x, steps[i].y});
        if (i == 0) continue;
        EXPECT_EQ(std::abs(steps[i].x - steps[i - 1].x) + std::abs(steps[i].y - steps[i - 1].y), 1);
    }
    EXPECT_EQ(seen.size(), steps.size());
}

TEST(Spread, IsMeanAndSampleDeviation) {
    const Spread spread = spread_of(std::vector<double>{1, 2, 3, 6});
    EXPECT_DOUBLE_EQ(spread.bias, 3);
    EXPECT_DOUBLE_EQ(spread.sigma, std::sqrt(14.0 / 3));
    EXPECT_EQ(spread_of(std::vector<double>{5}).sigma, 0);
    EXPECT_EQ(spread_of({}).bias, 0);
}

TEST(Summary, IsOfAbsoluteValuesAndLeavesOutWhatWasNotLocated) {
    std::vector<Station> stations(3);
    stations[0].located = stations[1].located = 20;
    stations[0].x_mm = {-0.3, 0.01};
    stations[1].x_mm = {0.1, 0.02};
    const Summary summary = summary_of(stations, [](const Station& s) { return s.x_mm; });
    EXPECT_DOUBLE_EQ(summary.best, 0.1);
    EXPECT_DOUBLE_EQ(summary.mean, 0.2);
    EXPECT_DOUBLE_EQ(summary.worst, 0.3);
    EXPECT_DOUBLE_EQ(summary.worst_sigma, 0.02);
    EXPECT_EQ(summary.stations, 2);
}

TEST(PrintModelTest, ReachesItsAmplitudesAndIsSmooth) {
    const PrintModel print(0.15, 0.27);
    Vec2 largest;
    for (const Step step : spiral(kPositionsPerSide)) {
        const Vec2 at{20.0 * step.x, 20.0 * step.y};
        const Vec2 shift = print.shift_mm(at);
        largest = {std::max(largest.x, std::abs(shift.x)), std::max(largest.y, std::abs(shift.y))};
        // The two points are 1.4 mm apart. The shift of the ink may change by at most 1 % of this
        // distance.
        const Vec2 beside = print.shift_mm({at.x + 1, at.y + 1});
        EXPECT_LT(std::hypot(beside.x - shift.x, beside.y - shift.y), 0.015);
    }
    EXPECT_NEAR(largest.x, 0.15, 1e-9);
    EXPECT_NEAR(largest.y, 0.27, 1e-9);
}

TEST(ProtocolTest, MeasuresTheModelledPrinter) {
    ProtocolOptions options;
    options.samples = 1;
    const Protocol protocol = run_protocol(options);
    ASSERT_EQ(protocol.printed.positions.size(), 121u);
    ASSERT_EQ(protocol.printed.angles.size(), 36u);
    const PrintModel print;
    int located = 0;
    for (const Station& station : protocol.printed.positions) {
        EXPECT_EQ(station.wrong, 0);
        if (station.located == 0) continue;
        ++located;
        // Where the ink is shifted to the right, the measured values are too small.
        const Vec2 shift = print.shift_mm(station.place_mm);
        EXPECT_NEAR(station.x_mm.bias, -shift.x, 0.010);
        EXPECT_NEAR(station.y_mm.bias, -shift.y, 0.010);
    }
    EXPECT_GE(located, 118);
    std::ostringstream figures;
    draw_figure_13(figures, protocol);
    EXPECT_EQ(test::XmlCheck(figures.str()).problem(), "");
    EXPECT_THAT(table_3(protocol), testing::HasSubstr("0.155 mm"));
    EXPECT_THAT(table_3(protocol), testing::HasSubstr("| Coordinate "));
}

TEST(SweepTest, CoversTheShareAskedFor) {
    for (const double direction_rad : {0.0, 0.7, 2.0, -3.0}) {
        GreyImage image{std::vector<std::uint8_t>(100 * 60, 200), 100, 60};
        cover(image, 0.25, direction_rad);
        const auto dark = std::ranges::count(image.pixels, 25);
        EXPECT_NEAR(static_cast<double>(dark), 1500, 100) << direction_rad;
    }
}

TEST(SweepTest, CountsEveryFrameAndDraws) {
    SweepOptions options;
    options.frames_per_value = 2;
    const Sweep sweep = run_sweep(SweepKind::occlusion, options);
    ASSERT_EQ(sweep.points.size(), sweep_values(SweepKind::occlusion).size());
    EXPECT_EQ(sweep.points.front().all.located, 2);
    EXPECT_EQ(sweep.points.back().all.located, 0);
    std::ostringstream csv;
    write_sweep_csv(csv, sweep);
    EXPECT_THAT(csv.str(), testing::StartsWith("occlusion,decoder,frames,located,wrong,"));
    std::ostringstream svg;
    draw_sweep(svg, sweep);
    EXPECT_EQ(test::XmlCheck(svg.str()).problem(), "");
}

TEST(SweepTest, KeepsTheValuesThatWereCompleteWhenItIsStopped) {
    SweepOptions options;
    options.frames_per_value = 1;
    const Sweep whole = run_sweep(SweepKind::noise, options);
    const auto stopped_after = [&options](int frames) {
        options.progress = [frames](int done, int) { return done < frames; };
        return run_sweep(SweepKind::noise, options);
    };
    const Sweep part = stopped_after(3);
    ASSERT_EQ(part.points.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(part.points[i].value, whole.points[i].value);
        EXPECT_EQ(part.points[i].all.position_um.max, whole.points[i].all.position_um.max);
    }
    EXPECT_THROW(stopped_after(2), Error);  // a curve cannot be drawn from a single value
}

TEST(PlotTest, TicksAreRoundNumbers) {
    EXPECT_DOUBLE_EQ(plot::tick_step(60, 5), 10);
    EXPECT_DOUBLE_EQ(plot::tick_step(1, 4), 0.25);
    EXPECT_DOUBLE_EQ(plot::tick_step(2.5, 5), 0.5);
    EXPECT_DOUBLE_EQ(plot::rounded_up(250), 250);
    EXPECT_DOUBLE_EQ(plot::rounded_up(0.0123), 0.015);
    const plot::Scale log{1, 20, true, 0, 1};
    EXPECT_THAT(log.ticks(4), testing::ElementsAre(1, 2, 5, 10, 20));
    EXPECT_NEAR(log.at(std::sqrt(20)), 0.5, 1e-9);
}

}  // namespace
}  // namespace dotpose::evaluate_detail

// Tests the measured dot centres in drawn frames whose dot positions are known.
#include "core/pose/measure.hpp"

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "../reading.hpp"
#include "core/pose/subgrid.hpp"

namespace dotpose::core_test::measure_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 45;

/// Draws paper with dots. The brightness decreases from one side of the image to the other.
GreyImage drawn(const View& view, const std::vector<PlacedDot>& dots, double angle) {
    GreyImage image = blank(static_cast<int>(view.image_px.x), static_cast<int>(view.image_px.y));
    const Vec2 way{std::cos(angle), std::sin(angle)};
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            const Vec2 p = Vec2{1.0 * u, 1.0 * v} - view.centre_px();
            pixel(image, u, v) =
                static_cast<std::uint8_t>(std::lround(170 + 0.6 * (p.x * way.x + p.y * way.y)));
        }
    }
    for (const PlacedDot& dot : dots)
        darken(image, dot.centre_px, 0.1 * view.spacing_px, 0.7);
    return image;
}

bool is_inside(const View& view, Vec2 point_px, double margin_px) {
    const Vec2 far = view.image_px - Vec2{1 + margin_px, 1 + margin_px};
    return point_px.x > margin_px && point_px.y > margin_px && point_px.x < far.x &&
           point_px.y < far.y;
}

/// Expects that all dots that are at least `margin_px` from the border are measured, with errors
/// below the tolerance. Dots closer to the border may be missing or have an error of up to a third
/// of a pixel because the border truncates the centroid window.
void expect_measured(const View& view, const std::vector<PlacedDot>& placed, int quarters,
                     double margin_px, double tolerance_px, Rng& rng) {
    const GreyImage image = drawn(view, placed, rng.uniform(0, 6.3));
    Reading reading(view, QuarterTurn{quarters}, dots_of(placed));
    ASSERT_EQ(reading.status, Status::ok);
    const Nominal nominal(reading.grid(), view.code, reading.truth());
    PlaneFromImage pose = upright_plane(reading.plane, reading.turn);
    // Adds an error of a few hundredths of a spacing, as in a pose from the first attempt.
    const Vec2 off{rng.uniform(-0.03, 0.03), rng.uniform(-0.03, 0.03)};
    pose.at_centre_q16 = fixed(real(pose.at_centre_q16, 16) + off, 16);
    std::vector<DetectedDot> measured(1000);
    const int count =
        measure_dots(image.view(), FixedLens{}, pose, nominal, reading.owned.grid, measured);
    int seen = 0;
    for (int j = reading.grid().j0; j < reading.grid().j0 + reading.grid().rows; ++j) {
        for (int c = reading.grid().i0; c < reading.grid().i0 + reading.grid().columns; ++c) {
            const GridCell& cell = reading.grid().at(c, j);
            if (!cell.has_dot()) continue;
            ASSERT_LT(int{cell.dot}, count);
            ++seen;
            const Vec2 found = real(measured[cell.dot].centre_q8, 8);
            const FixedVec step = reading.turn({c, j});
            const FixedVec at{step.x + reading.zero.x, step.y + reading.zero.y};
            const auto own = std::find_if(placed.begin(), placed.end(),
                                          [&](const PlacedDot& dot) { return dot.cell == at; });
            ASSERT_NE(own, placed.end());
            EXPECT_LT(length(found - own->centre_px),
                      is_inside(view, own->centre_px, margin_px) ? tolerance_px : 0.33)
                << own->centre_px.x << ", " << own->centre_px.y;
        }
    }
    EXPECT_LE(seen, count);
    const auto inside = std::count_if(placed.begin(), placed.end(), [&](const PlacedDot& dot) {
        return is_inside(view, dot.centre_px, margin_px);
    });
    EXPECT_GE(seen, inside);
}

TEST(MeasureDots, FindsTheirCentresInUnevenLight) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        View view = random_view(rng);
        view.spacing_px = rng.uniform(9, 16);
        expect_measured(view, pattern_dots(view), i % 4, 1.6, 0.09, rng);
    }
}

TEST(MeasureDots, FindsBadlyPrintedOnesWhereTheyAre) {
    // If printed dots scatter by 25 µm per axis, one dot in a hundred is displaced by at least 75
    // µm, which is 0.15 spacings. If such dots were lost, or were measured too close to their
    // nominal positions, the residuals would be smaller than the printing errors.
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        View view = random_view(rng);
        view.spacing_px = rng.uniform(9, 16);
        auto placed = pattern_dots(view);
        for (std::size_t d = 0; d < placed.size(); d += 20) {
            const double direction = rng.uniform(0, 6.3);
            Vec2& at = placed[d].centre_px;
            at = at + 0.15 * view.spacing_px * Vec2{std::cos(direction), std::sin(direction)};
        }
        // The tolerance is large because a displaced dot may be only half a spacing from a
        // neighbour. Its window then includes the rim of the neighbour.
        expect_measured(view, placed, i % 4, 7, 0.14, rng);
    }
}

TEST(MeasureDots, BlankPaperAndHiddenCellsHaveNone) {
    Rng rng(kSeed);
    const View view = random_view(rng);
    Reading reading(view, {});
    ASSERT_EQ(reading.status, Status::ok);
    const Nominal nominal(reading.grid(), view.code, reading.truth());
    std::vector<DetectedDot> measured(1000);
    EXPECT_EQ(measure_dots(blank(188, 120).view(), FixedLens{}, reading.plane, nominal,
                           reading.owned.grid, measured),
              0);
    for (GridCell& cell : reading.owned.cells) {
        EXPECT_FALSE(cell.has_dot());
        cell.dot = GridCell::kHidden + 0b1111;
    }
    EXPECT_EQ(measure_dots(drawn(view, pattern_dots(view), 0).view(), FixedLens{}, reading.plane,
                           nominal, reading.owned.grid, measured),
              0);
}

TEST(MeasureDots, DotsBesideGraphicsAreSeen) {
    Rng rng(kSeed);
    const View view = random_view(rng);
    const auto placed = pattern_dots(view);
    Reading reading(view, {}, dots_of(placed));
    ASSERT_EQ(reading.status, Status::ok);
    const Nominal nominal(reading.grid(), view.code, reading.truth());
    const Grid& grid = reading.grid();
    const auto symbol_at = [&](int i, int j) {
        return static_cast<int>(nominal.symbol(nominal.pattern_step({i, j})));
    };
    const auto mark = [&](auto hidden_places) {
        for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
            for (int i = grid.i0; i < grid.i0 + grid.columns; ++i)
                grid.at(i, j).dot =
                    static_cast<std::uint16_t>(GridCell::kHidden + hidden_places(symbol_at(i, j)));
        }
    };
    const GreyImage image = drawn(view, placed, 0);
    std::vector<DetectedDot> measured(1000);
    const auto count = [&] {
        return measure_dots(image.view(), FixedLens{}, upright_plane(reading.plane, reading.turn),
                            nominal, reading.owned.grid, measured);
    };
    mark([](int symbol) { return 0b1111 & ~(1 << symbol); });
    EXPECT_GT(count(), 100);
    mark([](int symbol) { return 1 << symbol; });
    EXPECT_EQ(count(), 0);
}

TEST(MeasureDots, StopsWhereTheirMemoryEnds) {
    Rng rng(kSeed);
    const View view = random_view(rng);
    Reading reading(view, {});
    ASSERT_EQ(reading.status, Status::ok);
    const Nominal nominal(reading.grid(), view.code, reading.truth());
    std::vector<DetectedDot> measured(11);
    EXPECT_EQ(measure_dots(drawn(view, pattern_dots(view), 0).view(), FixedLens{}, reading.plane,
                           nominal, reading.owned.grid, std::span(measured).first(10)),
              10);
    EXPECT_EQ(measured[10].centre_q8, FixedVec{});
    // No cell may refer to a dot that was not measured.
    EXPECT_EQ(std::count_if(reading.owned.cells.begin(), reading.owned.cells.end(),
                            [](const GridCell& cell) { return cell.has_dot() && cell.dot < 10; }),
              10);
    for (const GridCell& cell : reading.owned.cells) {
        if (cell.has_dot()) {
            EXPECT_LT(cell.dot, 10);
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::measure_test

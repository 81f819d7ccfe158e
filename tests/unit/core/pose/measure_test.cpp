// Centres measured in drawn frames whose dots are known.
#include "core/pose/measure.hpp"

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "../reading.hpp"
#include "core/pose/subgrid.hpp"

namespace dotpose::core_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 45;

/// Light that falls off from one side to the other, with the dots of the view on it.
GreyImage drawn(const View& view, double angle) {
    GreyImage image = blank(static_cast<int>(view.image_px.x), static_cast<int>(view.image_px.y));
    const Vec2 way{std::cos(angle), std::sin(angle)};
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            const Vec2 p = Vec2{1.0 * u, 1.0 * v} - view.centre_px();
            pixel(image, u, v) =
                static_cast<std::uint8_t>(std::lround(170 + 0.6 * (p.x * way.x + p.y * way.y)));
        }
    }
    for (const PlacedDot& dot : pattern_dots(view))
        darken(image, dot.centre_px, 0.1 * view.spacing_px, 0.7);
    return image;
}

TEST(MeasureDots, FindsTheirCentresInUnevenLight) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        View view = random_view(rng);
        view.spacing_px = rng.uniform(9, 16);
        const auto placed = pattern_dots(view);
        const GreyImage image = drawn(view, rng.uniform(0, 6.3));
        Reading reading(view, Turn{i % 4}, dots_of(placed));
        ASSERT_EQ(reading.status, Status::ok);
        const Nominal nominal(reading.grid(), view.profile, reading.truth());
        PlaneFromImage pose = upright_plane(reading.plane, reading.turn);
        // The pose as the first attempt leaves it, some hundredths of a spacing off.
        const Vec2 off{rng.uniform(-0.03, 0.03), rng.uniform(-0.03, 0.03)};
        pose.at_centre_q16 = fixed(real(pose.at_centre_q16, 16) + off, 16);
        std::vector<Dot> measured(1000);
        const int count =
            measure_dots(image.view(), Lens{}, pose, nominal, reading.owned.grid, measured);
        int seen = 0;
        for (int j = reading.grid().j0; j < reading.grid().j0 + reading.grid().rows; ++j) {
            for (int c = reading.grid().i0; c < reading.grid().i0 + reading.grid().columns; ++c) {
                const GridCell& cell = reading.grid().at(c, j);
                if (!cell.has_dot()) continue;
                ASSERT_LT(int{cell.dot}, count);
                ++seen;
                const Vec2 found = real(measured[cell.dot].centre_q8, 8);
                // The dot of this very cell.
                const Vec step = reading.turn({c, j});
                const Vec at{step.x + reading.zero.x, step.y + reading.zero.y};
                const auto own = std::find_if(placed.begin(), placed.end(),
                                              [&](const PlacedDot& dot) { return dot.cell == at; });
                ASSERT_NE(own, placed.end());
                EXPECT_LT(length(found - own->centre_px), 0.05)
                    << own->centre_px.x << ", " << own->centre_px.y;
            }
        }
        EXPECT_EQ(seen, count);
        const auto inside = std::count_if(placed.begin(), placed.end(), [&](const PlacedDot& dot) {
            const double margin = 6;
            return dot.centre_px.x > margin && dot.centre_px.y > margin &&
                   dot.centre_px.x < view.image_px.x - 1 - margin &&
                   dot.centre_px.y < view.image_px.y - 1 - margin;
        });
        EXPECT_GE(count, inside);
    }
}

TEST(MeasureDots, BlankPaperAndHiddenCellsHaveNone) {
    Rng rng(kSeed);
    const View view = random_view(rng);
    Reading reading(view, {});
    ASSERT_EQ(reading.status, Status::ok);
    const Nominal nominal(reading.grid(), view.profile, reading.truth());
    std::vector<Dot> measured(1000);
    EXPECT_EQ(measure_dots(blank(188, 120).view(), Lens{}, reading.plane, nominal,
                           reading.owned.grid, measured),
              0);
    for (GridCell& cell : reading.owned.cells) {
        EXPECT_FALSE(cell.has_dot());
        cell.dot = GridCell::kHidden;
    }
    EXPECT_EQ(measure_dots(drawn(view, 0).view(), Lens{}, reading.plane, nominal,
                           reading.owned.grid, measured),
              0);
}

TEST(MeasureDots, StopsWhereTheirMemoryEnds) {
    Rng rng(kSeed);
    const View view = random_view(rng);
    Reading reading(view, {});
    ASSERT_EQ(reading.status, Status::ok);
    const Nominal nominal(reading.grid(), view.profile, reading.truth());
    std::vector<Dot> measured(11);
    EXPECT_EQ(measure_dots(drawn(view, 0).view(), Lens{}, reading.plane, nominal,
                           reading.owned.grid, std::span(measured).first(10)),
              10);
    EXPECT_EQ(measured[10].centre_q8, Vec{});
    // Cells refer to none but the measured ones.
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
}  // namespace dotpose::core_test

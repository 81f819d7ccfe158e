#include "evaluate/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dotpose::plot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(plot_scale, has_the_same_ticks_in_both_directions) {
    EXPECT_THAT((Scale{-1, 4}).ticks(5), ElementsAre(-1, 0, 1, 2, 3, 4));
    EXPECT_THAT((Scale{4, -1}).ticks(5), ElementsAre(-1, 0, 1, 2, 3, 4));
}

TEST(plot_axes, number_a_y_axis_that_runs_down) {
    Svg svg(200, 200, "down");
    const Axes axes(svg, {50, 50, 100, 100}, {0, 10}, {30, 20});
    axes.draw_y("y [mm]");
    const std::string drawing = std::move(svg).finish();
    // The axis is reversed, with 20 at the top and 30 at the bottom. The baselines of the numbers
    // are 5 units below the ticks.
    EXPECT_THAT(drawing,
                HasSubstr(R"(y="55.00" font-size="15.00" text-anchor="end" fill="#6b7885">20<)"));
    EXPECT_THAT(drawing,
                HasSubstr(R"(y="155.00" font-size="15.00" text-anchor="end" fill="#6b7885">30<)"));
}

}  // namespace
}  // namespace dotpose::plot

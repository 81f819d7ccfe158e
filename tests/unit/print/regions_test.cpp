#include "print/regions.hpp"

#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"

namespace dotpose::print {
namespace {

TEST(regions, stand_side_by_side) {
    Regions regions({100, 7});
    EXPECT_EQ(regions.take(10, 20), (Cell{100, 7}));
    EXPECT_EQ(regions.take(30, 5), (Cell{110, 7}));
    EXPECT_EQ(regions.take(8, 8), (Cell{140, 7}));
}

TEST(regions, begin_a_new_line_below_the_highest_of_the_last) {
    const std::uint32_t start = kPositionsPerAxis - 50;
    Regions regions({start, 7});
    EXPECT_EQ(regions.take(20, 8), (Cell{start, 7}));
    EXPECT_EQ(regions.take(30, 12), (Cell{start + 20, 7}));  // fills the line up to the last cell
    EXPECT_EQ(regions.take(20, 8), (Cell{start, 19}));
    EXPECT_EQ(regions.take(31, 8), (Cell{start, 27}));
}

TEST(make_sheets, gives_every_page_cells_of_its_own) {
    SheetOptions options;
    // There is room for two regions of 394 columns side by side.
    options.origin = {kPositionsPerAxis - 1000, 5};
    const std::vector<Sheet> sheets = make_sheets(options, 5);
    ASSERT_EQ(sheets.size(), 5U);
    for (std::size_t a = 0; a < sheets.size(); ++a) {
        validate(sheets[a]);
        for (std::size_t b = 0; b < a; ++b) {
            const auto apart = [&](std::uint32_t Cell::*axis, int Sheet::*count) {
                const auto end = [&](const Sheet& sheet) {
                    return sheet.origin.*axis + static_cast<std::uint32_t>(sheet.*count);
                };
                return end(sheets[a]) <= sheets[b].origin.*axis ||
                       end(sheets[b]) <= sheets[a].origin.*axis;
            };
            EXPECT_TRUE(apart(&Cell::x, &Sheet::columns) || apart(&Cell::y, &Sheet::rows))
                << a << " and " << b;
        }
    }
    EXPECT_EQ(sheets[2].origin, (Cell{options.origin.x, 5U + 565U}));
}

TEST(make_sheets, refuses_counts_and_regions_that_do_not_exist) {
    SheetOptions options;
    EXPECT_THROW(make_sheets(options, 0), BadArgument);
    EXPECT_THROW(make_sheets(options, kMaxPages + 1), BadArgument);
    // There is room for two regions.
    options.origin = {kPositionsPerAxis - 394, kPositionsPerAxis - 2 * 565};
    EXPECT_EQ(make_sheets(options, 2).size(), 2U);
    EXPECT_THROW(make_sheets(options, 3), BadArgument);
}

}  // namespace
}  // namespace dotpose::print

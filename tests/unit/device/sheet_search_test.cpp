// Tests the search for places on known sheets.
#include "device/sheet_search.hpp"

#include <gtest/gtest.h>

#include "drawn_grid.hpp"

namespace dotpose::core_test::sheet_search_test {
namespace {

constexpr std::uint64_t kSeed = 4218;
constexpr std::array kSheets{KnownRegion{CodeVariant::anoto, {}, {0, 1024}, 393, 564},
                             KnownRegion{CodeVariant::anoto, {7, 60}, {5000, 10}, 100, 150},
                             KnownRegion{CodeVariant::libdots, {}, {9000, 9000}, 50, 50}};

std::optional<core::SheetPlace> find(const DrawnGrid& drawn, CodeVariant code, int max_wrong) {
    const core::HardBlock block(drawn.grid(), drawn.region());
    return core::find_on_sheets(block, code, kSheets, max_wrong);
}

Cell place_on(const KnownRegion& sheet, Rng& rng) {
    return {sheet.first.x + rng.below(sheet.columns - 10),
            sheet.first.y + rng.below(sheet.rows - 10)};
}

TEST(FindOnSheets, FindsThePlaceOnEverySheetInEveryTurn) {
    Rng rng(kSeed);
    for (const KnownRegion& sheet : kSheets) {
        for (int trial = 0; trial < 40; ++trial) {
            const Cell at = place_on(sheet, rng);
            const Drawing drawing{.columns = 7, .rows = 6, .quarters = trial % 4, .missing = 0.05};
            const auto found = find(DrawnGrid(sheet, at, drawing, rng), sheet.code, 0);
            ASSERT_TRUE(found) << trial;
            EXPECT_EQ(found->quarters, drawing.quarters);
            EXPECT_EQ(found->corner, (Place{at, sheet.section}));
        }
    }
}

TEST(FindOnSheets, FindsPlacesWithWrongBits) {
    Rng rng(kSeed, 1);
    int found = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Cell at = place_on(kSheets[0], rng);
        const Drawing drawing{.columns = 9, .rows = 9, .quarters = trial % 4, .wrong = 0.03};
        const auto place = find(DrawnGrid(kSheets[0], at, drawing, rng), CodeVariant::anoto, 12);
        if (!place) continue;
        ++found;
        EXPECT_EQ(place->corner.cell, at);
        EXPECT_LE(place->wrong[0] + place->wrong[1], 12);
    }
    EXPECT_GE(found, 97);
}

TEST(FindOnSheets, FindsViewsBeyondTheEdges) {
    Rng rng(kSeed, 2);
    const KnownRegion& sheet = kSheets[1];
    const Cell at{sheet.first.x - 5, sheet.first.y + sheet.rows - 2};
    const auto found = find(DrawnGrid(sheet, at, {.columns = 8, .rows = 8}, rng), sheet.code, 0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->corner.cell, at);
}

TEST(FindOnSheets, FindsNoOtherPlaces) {
    Rng rng(kSeed, 3);
    const KnownRegion elsewhere{CodeVariant::anoto, {}, {100'000, 200'000}, 400, 400};
    for (int trial = 0; trial < 20; ++trial) {
        const DrawnGrid drawn(elsewhere, place_on(elsewhere, rng), {.columns = 7, .rows = 7}, rng);
        EXPECT_FALSE(find(drawn, CodeVariant::anoto, 4));
    }
    // These searches use code variants other than that of the sheet.
    const DrawnGrid drawn(kSheets[2], place_on(kSheets[2], rng), {.columns = 7, .rows = 7}, rng);
    EXPECT_FALSE(find(drawn, CodeVariant::microdots, 4));
    EXPECT_FALSE(find(drawn, CodeVariant::libdots, -1));
}

TEST(FindOnSheets, HandlesBlocksWithoutLines) {
    Rng rng(kSeed, 4);
    for (const double missing : {1.0, 0.9}) {
        const Drawing drawing{.columns = 1, .rows = 3, .missing = missing};
        EXPECT_FALSE(find(DrawnGrid(kSheets[0], {100, 1100}, drawing, rng), CodeVariant::anoto, 0));
    }
}

}  // namespace
}  // namespace dotpose::core_test::sheet_search_test

// Tests the search for the position along an axis. Some of the bits in the lines are wrong.
#include "core/decode/search.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "../../code/reference.hpp"
#include "../geometry.hpp"

namespace dotpose::core_test::search_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 43;

/// A window with only the x bits (as weights), and storage for the scores of its columns.
struct ScoredWindow {
    ScoredWindow(int columns, int rows) : owned(std::max(columns, rows)) {
        owned.grid.columns = columns;
        owned.grid.rows = rows;
    }

    Status find(CodeVariant code, AxisReading& reading) {
        const GridRegion all{0, 0, owned.grid.columns, owned.grid.rows};
        return find_axis(code, score_lines(Upright(owned.grid, all, {}), Axis::x, storage),
                         reading);
    }

    OwnedGrid owned;
    std::array<ScoredLine, kMaxLines> storage;
};

/// Returns the window of the code at a place. Each bit is flipped with probability `flipped`.
ScoredWindow window(CodeVariant code, const Place& place, int columns, int rows, double flipped,
                    Rng& rng) {
    ScoredWindow result(columns, rows);
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const Place at = moved(code, place, i, j);
            const int bit = x_bit(symbol_at(code, at.cell, at.section));
            const bool is_one = (bit == 1) != (rng.uniform() < flipped);
            result.owned.grid.at(i, j).x = is_one ? 127 : -127;
        }
    }
    return result;
}

int roll_at(CodeVariant code, const Place& place) {
    const auto cross = static_cast<int>(place.cell.y % 63);
    return (code_test::reference_roll(code, place.cell.x) + place.section.u + cross) % 63;
}

/// Returns how many of 200 random windows with 20 columns are found.
int found_of_200(CodeVariant code, int rows, double flipped) {
    Rng rng(kSeed);
    int found = 0;
    for (int i = 0; i < 200; ++i) {
        const Place place = random_place(rng);
        ScoredWindow lines = window(code, place, 20, rows, flipped, rng);
        AxisReading reading;
        if (lines.find(code, reading) != Status::ok) continue;
        found += reading.position == place.cell.x && reading.roll == roll_at(code, place);
    }
    return found;
}

TEST(ScoreLines, TellsByHowMuchTheBestOfEachLineLeads) {
    Rng rng(kSeed);
    for (const int columns : {1, 2, 7, 8, 9, 20}) {
        ScoredWindow lines = window(CodeVariant::anoto, random_place(rng), columns, 12, 0.1, rng);
        const GridRegion all{0, 0, columns, 12};
        score_lines(Upright(lines.owned.grid, all, {}), Axis::x, lines.storage);
        for (int i = 0; i < columns; ++i) {
            const ScoredLine& line = lines.storage[static_cast<std::size_t>(i)];
            LineScores sorted = line.scores;
            std::sort(sorted.begin(), sorted.end(), std::greater<>());
            EXPECT_EQ(line.best.score, sorted[0]) << "line " << i << " of " << columns;
            EXPECT_EQ(line.best.margin, sorted[0] - sorted[1]) << "line " << i << " of " << columns;
        }
    }
}

TEST(FindAxis, FindsThePositionAmongWrongBits) {
    // Longer lines tolerate a larger fraction of wrong bits. If every fifth bit is wrong, for
    // example, only half of the windows with 12 rows are found.
    for (const CodeVariant code : {CodeVariant::anoto, CodeVariant::microdots}) {
        EXPECT_GE(found_of_200(code, 12, 0.08), 198) << "seed " << kSeed;
        EXPECT_GE(found_of_200(code, 20, 0.12), 198) << "seed " << kSeed;
        EXPECT_GE(found_of_200(code, 30, 0.2), 198) << "seed " << kSeed;
    }
}

TEST(FindAxis, HoldsForThePublishedCode) {
    // In the `libdots` code, eight consecutive lines are necessary to determine a position.
    EXPECT_EQ(found_of_200(CodeVariant::libdots, 12, 0), 200) << "seed " << kSeed;
    EXPECT_GE(found_of_200(CodeVariant::libdots, 12, 0.05), 198) << "seed " << kSeed;
    EXPECT_GE(found_of_200(CodeVariant::libdots, 30, 0.2), 198) << "seed " << kSeed;
}

TEST(FindAxis, CleanLinesGiveAllThatThereIsToBeHad) {
    Rng rng(kSeed);
    for (const int columns : {6, 7, 20, kMaxLines}) {
        // The window of 20 columns extends across the end of the code.
        Place place = random_place(rng);
        if (columns == 20) place.cell.x = kPositionsPerAxis - 10;
        ScoredWindow lines = window(CodeVariant::anoto, place, columns, 12, 0, rng);
        AxisReading reading;
        ASSERT_EQ(lines.find(CodeVariant::anoto, reading), Status::ok) << columns;
        EXPECT_EQ(reading.position, place.cell.x) << columns;
        EXPECT_EQ(reading.roll, roll_at(CodeVariant::anoto, place)) << columns;
        EXPECT_EQ(reading.score, 127 * 12 * columns);
        EXPECT_EQ(reading.max_possible, reading.score);
        EXPECT_TRUE(reading.is_clear());
    }
}

TEST(FindAxis, ThePositionIsThatOfTheFirstLineWhereverTheClearRunLies) {
    Rng rng(kSeed);
    for (int clear = 0; clear <= 10; ++clear) {
        const Place place = random_place(rng);
        ScoredWindow lines = window(CodeVariant::anoto, place, 16, 12, 0, rng);
        for (int j = 0; j < 12; ++j) {
            for (int i = 0; i < 16; ++i) {
                if (i < clear || i >= clear + 6) lines.owned.grid.at(i, j).x = 0;
            }
        }
        AxisReading reading;
        ASSERT_EQ(lines.find(CodeVariant::anoto, reading), Status::ok)
            << clear << ", seed " << kSeed;
        EXPECT_EQ(reading.position, place.cell.x) << clear << ", seed " << kSeed;
        EXPECT_EQ(reading.score, 127 * 12 * 6) << clear;
    }
}

TEST(FindAxis, GraphicsMayHideLinesSoThatNoSixAreInARow) {
    Rng rng(kSeed);
    int right = 0;
    for (int i = 0; i < 100; ++i) {
        const Place place = random_place(rng);
        ScoredWindow lines = window(CodeVariant::anoto, place, 12, 12, 0.02, rng);
        for (int j = 0; j < 12; ++j)
            lines.owned.grid.at(5, j).x = lines.owned.grid.at(6, j).x = 0;
        AxisReading reading;
        if (lines.find(CodeVariant::anoto, reading) != Status::ok) continue;
        right +=
            reading.position == place.cell.x && reading.roll == roll_at(CodeVariant::anoto, place);
    }
    EXPECT_GE(right, 99) << "seed " << kSeed;
}

TEST(FindAxis, RandomBitsAreNotInTheCodeOrScoreLow) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        ScoredWindow lines = window(CodeVariant::anoto, random_place(rng), 20, 12, 0.5, rng);
        AxisReading reading;
        if (lines.find(CodeVariant::anoto, reading) == Status::not_in_code) continue;
        // Each line has 12 random bits. The best of the 63 rolls of a line agrees with 9 or 10 of
        // these bits. The search selects a run of 6 lines that agree this well with one position,
        // but the other 14 lines score 0 on average. The total score is therefore far below the
        // maximum.
        EXPECT_FALSE(reading.is_clear()) << i << ", seed " << kSeed;
        EXPECT_LT(reading.score, reading.max_possible * 7 / 10) << i << ", seed " << kSeed;
    }
}

TEST(FindAxis, FewerLinesThanCarryAPositionAreNotInTheCode) {
    Rng rng(kSeed);
    AxisReading reading;
    for (const int columns : {1, 5}) {
        EXPECT_EQ(window(CodeVariant::anoto, random_place(rng), columns, 12, 0, rng)
                      .find(CodeVariant::anoto, reading),
                  Status::not_in_code);
    }
    // Because of the misprint in a4, the `libdots` code needs eight lines instead of six.
    const Place place = random_place(rng);
    EXPECT_EQ(
        window(CodeVariant::libdots, place, 7, 12, 0, rng).find(CodeVariant::libdots, reading),
        Status::not_in_code);
    EXPECT_EQ(
        window(CodeVariant::libdots, place, 8, 12, 0, rng).find(CodeVariant::libdots, reading),
        Status::ok);
    EXPECT_EQ(reading.position, place.cell.x);
}

}  // namespace
}  // namespace dotpose::core_test::search_test

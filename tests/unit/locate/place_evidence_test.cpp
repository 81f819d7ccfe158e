// Tests the search for the place of a block of bits, without an image.
#include "locate/place_evidence.hpp"

#include <array>
#include <cstdint>
#include <optional>

#include <gtest/gtest.h>

#include "../core/geometry.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::place_evidence_test {
namespace {

constexpr std::uint64_t kSeed = 4711;
constexpr int kHalf = 8;  ///< the blocks contain the cells [-kHalf, kHalf) along each axis

void set_bit(core::BitLines& lines, int line, int cell, int bit) {
    const auto i = static_cast<std::size_t>(line + core::BitBlock::kMiddle);
    lines.valid[i] |= std::uint64_t{1} << (cell + core::BitBlock::kMiddle);
    lines.bits[i] |= static_cast<std::uint64_t>(bit) << (cell + core::BitBlock::kMiddle);
}

/// Returns a block of bits of the code. `place` is the place of its cell (0, 0).
core::BitBlock upright_block(CodeVariant code, const Place& place) {
    core::BitBlock block;
    for (int j = -kHalf; j < kHalf; ++j) {
        for (int i = -kHalf; i < kHalf; ++i) {
            const Place at = moved(code, place, i, j);
            const Symbol symbol = symbol_at(code, at.cell, at.section);
            set_bit(block.columns, i, j, x_bit(symbol));
            set_bit(block.rows, j, i, y_bit(symbol));
        }
    }
    return block;
}

/// Returns a block of bits of the code, in the shape of a strip at an angle to the grid. The strip
/// has 18 columns of 5 cells, and steps down by one cell every two columns. Most lines are too
/// short to determine their rolls.
core::BitBlock slanted_block(CodeVariant code, const Place& place) {
    constexpr int kColumns = 18;
    constexpr int kHeight = 5;
    core::BitBlock block;
    for (int i = 0; i < kColumns; ++i) {
        for (int n = 0; n < kHeight; ++n) {
            const int column = i - kColumns / 2;
            const int row = n - kHeight / 2 + column / 2;
            const Place at = moved(code, place, column, row);
            const Symbol symbol = symbol_at(code, at.cell, at.section);
            set_bit(block.columns, column, row, x_bit(symbol));
            set_bit(block.rows, row, column, y_bit(symbol));
        }
    }
    return block;
}

std::optional<core::TurnedPlace> found(const core::BitBlock& block, CodeVariant code,
                                       const core::KnownSheets& known = {},
                                       core::PlaceSearch search = core::PlaceSearch::brief) {
    DeviceOptions options;
    options.code = code;
    core::EarlierBits earlier;
    std::array<core::ScoredLine, 128> scores{};
    core::WorkLimit work(0);
    return core::find_turned_place(
        {core::kernels(), options, known, earlier, scores, nullptr, work}, block, search);
}

Place random_place(Rng& rng) {
    const auto below = [&](std::uint32_t limit) {
        return static_cast<std::uint32_t>(rng.uniform() * limit);
    };
    return {{1000 + below(1000000), 1000 + below(1000000)},
            {static_cast<std::uint8_t>(below(63)), static_cast<std::uint8_t>(below(63))}};
}

TEST(PlaceEvidence, FindsBlocksOfAllCodesAtAllTurns) {
    Rng rng(kSeed, 0);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const CodeVariant code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const Place place = random_place(rng);
        const int quarters = i % 4;
        const auto result = found(core::turned(quarters, upright_block(code, place)), code);
        ASSERT_TRUE(result);
        EXPECT_EQ(result->quarters, (4 - quarters) % 4);
        EXPECT_EQ(result->place.cell, place.cell);
        EXPECT_EQ(result->place.section, place.section);
    }
}

TEST(PlaceEvidence, PlacesOutsideTheKnownSheetsAreRefusedIfOtherSheetsAreImpossible) {
    Rng rng(kSeed, 1);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const CodeVariant code = CodeVariant::anoto;
        const Place place = random_place(rng);
        const core::BitBlock block = upright_block(code, place);
        const std::array around{
            KnownRegion{code, place.section, {place.cell.x - 100, place.cell.y - 100}, 200, 200}};
        const std::array beside{
            KnownRegion{code, place.section, {place.cell.x + 100, place.cell.y + 100}, 200, 200}};
        const auto on_sheet = found(block, code, {around, OtherSheets::impossible});
        ASSERT_TRUE(on_sheet);
        EXPECT_EQ(on_sheet->place.cell, place.cell);
        EXPECT_FALSE(found(block, code, {beside, OtherSheets::impossible}));
        EXPECT_TRUE(found(block, code, {beside, OtherSheets::possible}));
    }
}

TEST(PlaceEvidence, FindsBlocksOfShortLinesThoroughly) {
    Rng rng(kSeed, 2);
    constexpr int kBlocks = 100;
    int right = 0;
    for (int i = 0; i < kBlocks; ++i) {
        const CodeVariant code = CodeVariant::anoto;
        const Place place = random_place(rng);
        const core::BitBlock block = core::turned(i % 4, slanted_block(code, place));
        const auto result = found(block, code, {}, core::PlaceSearch::thorough);
        const bool is_right = result && result->quarters == (4 - i % 4) % 4 &&
                              result->place.cell == place.cell &&
                              result->place.section == place.section;
        right += is_right ? 1 : 0;
    }
    // The brief search would find only 8 of the kBlocks blocks.
    EXPECT_GE(right, kBlocks * 99 / 100);
}

}  // namespace
}  // namespace dotpose::core_test::place_evidence_test

// Tests the p_wrong that is computed for error-free bits. Compares it with sums over all
// alternatives in double precision.
#include <algorithm>

#include <gtest/gtest.h>

#include "code_blocks.hpp"
#include "core/decode/bit_lines.hpp"
#include "core/integrity/certainty.hpp"
#include "core/integrity/coded_block.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::plain_certainty_test {
namespace {

constexpr std::uint64_t kSeed = 79;

/// Judges the claim that the bits of `block` are at the place `claimed`, and returns the verdict.
Verdict judge_plainly(const Block& block, const Place& claimed,
                      const IntegrityOptions& options = {}) {
    Block there = block;
    there.place = claimed;
    core::BitBlock words;
    std::array<core::Confidence, 2> confidences;
    std::array<std::vector<std::uint8_t>, 2> rolls;
    for (const bool is_x : {true, false}) {
        const std::size_t axis = is_x ? 0 : 1;
        const auto own = rolls_of(there, is_x, 0, 0, 0);
        rolls[axis].assign(own.begin(), own.end());
        const int wrong = contradictions(block, is_x, own);
        const auto read =
            std::count_if(block.x.begin(), block.x.end(), [](int bit) { return bit >= 0; });
        confidences[axis].add(127, true, wrong);
        confidences[axis].add(127, false, static_cast<int>(read) - wrong);
    }
    // Cell (0, 0) is in the middle of the block.
    const int first_column = -block.columns / 2;
    const int first_row = -block.rows / 2;
    for (int row = 0; row < block.rows; ++row) {
        for (int column = 0; column < block.columns; ++column) {
            const std::size_t i = block.index(column, row);
            if (block.x[i] < 0) continue;
            const auto u =
                static_cast<std::size_t>(core::BitBlock::kMiddle + first_column + column);
            const auto v = static_cast<std::size_t>(core::BitBlock::kMiddle + first_row + row);
            words.columns.valid[u] |= std::uint64_t{1} << v;
            words.columns.bits[u] |= static_cast<std::uint64_t>(block.x[i]) << v;
            words.rows.valid[v] |= std::uint64_t{1} << u;
            words.rows.bits[v] |= static_cast<std::uint64_t>(block.y[i]) << u;
        }
    }
    core::CellsInView view;
    view.column_rolls = rolls[0].data();
    view.row_rolls = rolls[1].data();
    view.first_column = first_column;
    view.first_row = first_row;
    view.columns = block.columns;
    view.rows = block.rows;
    const Place middle = moved(block.code, claimed, -first_column, -first_row);
    const core::CodedBlock coded(block.code, middle, view, words);
    Verdict verdict;
    verdict.is_certain = core::passes_hard_bit_test(
        core::kernels(),
        {coded.axis(core::Axis::x, confidences[0]), coded.axis(core::Axis::y, confidences[1])},
        block.code, options, verdict.fix);
    return verdict;
}

TEST(IsPlainlyCertain, NeverClaimsMoreThanTheExactSum) {
    Rng rng(kSeed);
    int certain = 0;
    int doubtful = 0;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = random_block(rng, i, 0.1, i % 4 == 0 ? 0 : 0.04);
        IntegrityOptions options;
        options.max_p_wrong_log2 = i % 2 == 0 ? -30 : -8;
        const Verdict verdict = judge_plainly(block, block.place, options);
        if (!verdict.is_certain) continue;
        ++certain;
        doubtful += verdict.fix.p_wrong_log2 > -30;
        EXPECT_LE(verdict.fix.p_wrong_log2, options.max_p_wrong_log2);
        EXPECT_GE(verdict.fix.p_wrong_log2, exact_log2(block) - 0.02);
    }
    EXPECT_GE(certain, 60);
    EXPECT_GE(doubtful, 5);
}

TEST(IsPlainlyCertain, AcceptsWhatIsClearlyRead) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = cut_block(code_test::kCodeVariants[static_cast<std::size_t>(i % 3)],
                                      any_place(rng), 17, 13);
        const Verdict verdict = judge_plainly(block, block.place);
        EXPECT_TRUE(verdict.is_certain);
        EXPECT_EQ(verdict.fix.bit_errors, 0);
    }
}

TEST(IsPlainlyCertain, RefusesWrongPlaces) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = random_block(rng, i, 0.1, 0.02);
        Place wrong = block.place;
        if (i % 4 == 0) wrong = any_place(rng);
        if (i % 4 == 1) wrong = moved(block.code, wrong, 1, 0);
        if (i % 4 == 2) wrong.section.u = static_cast<std::uint8_t>((wrong.section.u + 1) % 63);
        if (i % 4 == 3) wrong.cell.y = (wrong.cell.y + 236 * 233 * 31) % kPositionsPerAxis;
        IntegrityOptions any;
        any.max_bit_error_q8 = 256;
        EXPECT_FALSE(judge_plainly(block, wrong).is_certain);
        EXPECT_FALSE(judge_plainly(block, wrong, any).is_certain);
    }
}

TEST(IsPlainlyCertain, RefusesWhatASeamExplainsBetter) {
    Rng rng(kSeed);
    int alone = 0;
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        Block block = cut_block(CodeVariant::anoto, any_place(rng), 16, 16);
        alone += judge_plainly(block, block.place).is_certain;
        // Replaces the x bits of columns 5 to 15 with those of another section.
        Place other = block.place;
        other.section.u = static_cast<std::uint8_t>((other.section.u + 30) % 63);
        const Block beyond = cut_block(CodeVariant::anoto, other, 16, 16);
        for (int row = 0; row < 16; ++row) {
            for (int column = 5; column < 16; ++column)
                block.x[block.index(column, row)] = beyond.x[block.index(column, row)];
        }
        IntegrityOptions any;
        any.max_bit_error_q8 = 256;
        EXPECT_FALSE(judge_plainly(block, block.place, any).is_certain);
    }
    EXPECT_GE(alone, 28);
}

}  // namespace
}  // namespace dotpose::core_test::plain_certainty_test

// Tests p_wrong, the upper bound on the probability that a fix of the first or the tracked attempt
// is wrong. The expected values are double-precision sums over all alternatives.
#include "core/integrity/certainty.hpp"

#include <gtest/gtest.h>

#include "code_blocks.hpp"
#include "core/decode/bit_lines.hpp"
#include "core/integrity/coded_block.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::certainty_test {
namespace {

constexpr std::uint64_t kSeed = 79;

/// Judges the claim that the bits of `block` are at the place `claimed`, and returns the verdict.
Verdict judge(const Block& block, const Place& claimed, const IntegrityOptions& options = {}) {
    core::BitBlock words;
    core::Evidence evidence;
    evidence.corner = claimed;
    for (int row = 0; row < block.rows; ++row) {
        for (int column = 0; column < block.columns; ++column) {
            const std::size_t i = block.index(column, row);
            if (block.x[i] < 0) continue;
            const Place at = moved(block.code, claimed, column, row);
            const Symbol symbol = symbol_at(block.code, at.cell, at.section);
            evidence.bits[0].add(127, block.x[i] != x_bit(symbol));
            evidence.bits[1].add(127, block.y[i] != y_bit(symbol));
            const auto set = [](core::BitLines& lines, int line, int cell, int bit) {
                lines.valid[static_cast<std::size_t>(line)] |= std::uint64_t{1} << cell;
                lines.bits[static_cast<std::size_t>(line)] |= static_cast<std::uint64_t>(bit)
                                                              << cell;
            };
            set(words.columns, column, row, block.x[i]);
            set(words.rows, row, column, block.y[i]);
        }
    }
    std::array<core::ScoredLine, 2 * core::kMaxLines> storage;
    const core::BlockLines lines = core::score_block(core::kernels(), words, storage);
    evidence.columns = lines.columns;
    evidence.rows = lines.rows;
    Verdict verdict;
    core::WorkLimit work(core::WorkLimit::kOfImage);
    verdict.is_certain =
        core::is_certain(core::kernels(), evidence, block.code, options, work, verdict.fix);
    return verdict;
}

TEST(IsCertain, NeverClaimsMoreThanTheExactSum) {
    Rng rng(kSeed);
    int certain = 0;
    for (int i = 0; i < 150; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = random_block(rng, i, 0.15, 0.08);
        IntegrityOptions options;
        options.max_p_wrong_log2 = i % 2 == 0 ? -30 : -8;
        const Verdict verdict = judge(block, block.place, options);
        if (!verdict.is_certain) continue;
        ++certain;
        EXPECT_LE(verdict.fix.p_wrong_log2, options.max_p_wrong_log2);
        EXPECT_GE(verdict.fix.p_wrong_log2, exact_log2(block) - 0.02);
    }
    EXPECT_GE(certain, 60);
}

TEST(IsCertain, AcceptsWhatIsClearlyRead) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = cut_block(code_test::kCodeVariants[static_cast<std::size_t>(i % 3)],
                                      any_place(rng), 14, 13);
        const Verdict verdict = judge(block, block.place);
        EXPECT_TRUE(verdict.is_certain);
        EXPECT_EQ(verdict.fix.bit_errors, 0);
    }
}

/// Returns a block that agrees equally well with its own place and with an alternative. Of the bits
/// in which the two places differ, half agree with one place and half with the other.
Block between(const Block& block, const std::vector<int>& own,
              const std::vector<int>& alternative) {
    Block mixed = block;
    int differing = 0;
    for (int column = 0; column < block.columns; ++column) {
        for (int row = 0; row < block.rows; ++row) {
            const auto bit = [&](const std::vector<int>& rolls) {
                return code_test::digit_at(
                    code_test::kMainText,
                    static_cast<std::uint64_t>(rolls[static_cast<std::size_t>(column)] + row));
            };
            if (bit(own) != bit(alternative) && differing++ % 2 == 0)
                mixed.x[block.index(column, row)] = bit(alternative);
        }
    }
    return mixed;
}

TEST(IsCertain, RefusesWhatAnAlternativeExplainsAsWell) {
    Rng rng(kSeed);
    int without_errors = 0;
    for (int i = 0; i < 24; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = cut_block(code_test::kCodeVariants[static_cast<std::size_t>(i % 3)],
                                      any_place(rng), 11, 12);
        const auto own = rolls_of(block, true, 0, 0, 0);
        // Selects the alternative that disagrees with the fewest bits of the block, but at least
        // one.
        std::vector<int> worst;
        int fewest = INT32_MAX;
        const auto texts = code_test::secondary_texts(block.code);
        for (std::size_t n = 0; n < texts.size(); ++n) {
            for (int further = 1; further < static_cast<int>(texts[n].size()); ++further) {
                for (std::size_t line = 0; line < own.size(); ++line) {
                    const auto alternative = rolls_of(block, true, n, further, 0);
                    const auto shifted = rolls_of(block, true, n, further,
                                                  (own[line] - alternative[line] + 63) % 63);
                    const int bits = contradictions(block, true, shifted);
                    if (bits == 0 || bits >= fewest) continue;
                    fewest = bits;
                    worst = shifted;
                }
            }
        }
        ASSERT_FALSE(worst.empty());
        IntegrityOptions options;
        // Allows any number of bit errors, so that only the alternatives can cause a refusal.
        options.max_bit_error_q8 = 256;
        without_errors += judge(block, block.place, options).is_certain;
        EXPECT_FALSE(judge(between(block, own, worst), block.place, options).is_certain);
    }
    EXPECT_GE(without_errors, 20);
}

TEST(IsCertain, RefusesWrongPlaces) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = random_block(rng, i, 0.1, 0.02);
        Place wrong = block.place;
        if (i % 5 == 0) wrong = any_place(rng);
        if (i % 5 == 1) wrong = moved(block.code, wrong, 1, 0);
        if (i % 5 == 2) wrong = moved(block.code, wrong, 0, -1);
        if (i % 5 == 3) wrong.section.u = static_cast<std::uint8_t>((wrong.section.u + 1) % 63);
        if (i % 5 == 4) wrong.cell.y = (wrong.cell.y + 236 * 233 * 31) % kPositionsPerAxis;
        IntegrityOptions any;
        any.max_bit_error_q8 = 256;
        EXPECT_FALSE(judge(block, wrong).is_certain);
        EXPECT_FALSE(judge(block, wrong, any).is_certain);
    }
}

TEST(IsCertain, RefusesTwoPatternsWhateverTheLimit) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        const Block block =
            damaged(cut_block(CodeVariant::anoto, any_place(rng), 30, 30), 0, 0.25, rng);
        IntegrityOptions options;
        options.max_p_wrong_log2 = 0;
        EXPECT_FALSE(judge(block, block.place, options).is_certain) << i << ", seed " << kSeed;
    }
}

/// Returns the verdict of `verify` on the bits of a block.
Verdict verify_block(const Block& block, const IntegrityOptions& options) {
    std::vector<GridCell> cells(block.x.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (block.x[i] < 0) continue;
        cells[i] = {static_cast<std::int8_t>(block.x[i] != 0 ? 127 : -127),
                    static_cast<std::int8_t>(block.y[i] != 0 ? 127 : -127),
                    static_cast<std::uint16_t>(i)};
    }
    const core::Grid grid{cells, 64, 0, 0, block.columns, block.rows};
    Decoding decoding;
    decoding.region = {0, 0, block.columns, block.rows};
    decoding.window = {0, 0, 8, 8};
    decoding.place = block.place;
    std::array<core::ScoredLine, 2 * core::kMaxLines> storage;
    Verdict verdict;
    core::WorkLimit work(core::WorkLimit::kOfImage);
    verdict.is_certain = core::verify(core::kernels(), grid, block.code, nullptr, options, storage,
                                      work, decoding, verdict.fix) == Status::ok;
    return verdict;
}

TEST(IsCertain, AgreesWithVerify) {
    Rng rng(kSeed);
    int both = 0;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = random_block(rng, i, 0.2, 0.1);
        const Verdict ours = judge(block, block.place);
        if (!ours.is_certain) continue;
        // A block that `is_certain` accepts must also be certain according to `verify`, up to
        // rounding.
        IntegrityOptions options;
        options.max_p_wrong_log2 = -28;
        const Verdict theirs = verify_block(block, options);
        EXPECT_TRUE(theirs.is_certain);
        EXPECT_EQ(ours.fix.bit_errors, theirs.fix.bit_errors);
        ++both;
    }
    EXPECT_GE(both, 60);
}

}  // namespace
}  // namespace dotpose::core_test::certainty_test

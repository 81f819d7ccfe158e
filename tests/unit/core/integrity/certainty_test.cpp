// The claim of the first and tracked attempts compared with sums over all alternatives in double
// precision.
#include "core/integrity/certainty.hpp"

#include <gtest/gtest.h>

#include "../../code/reference.hpp"
#include "chance.hpp"
#include "core/decode/bit_lines.hpp"
#include "core/integrity/coded_block.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test {
namespace {

constexpr std::uint64_t kSeed = 79;

/// Bits of a block of the code from `place` on: 1, 0, or -1 for a bit that was not read.
struct Block {
    Profile profile;
    Place place;
    int columns;
    int rows;
    std::vector<int> x;
    std::vector<int> y;

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row * columns + column);
    }
};

Block cut_block(Profile profile, const Place& place, int columns, int rows) {
    Block block{profile, place, columns, rows, {}, {}};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const Place at = moved(profile, place, column, row);
            const Symbol symbol = symbol_at(profile, at.cell, at.section);
            block.x.push_back(x_bit(symbol));
            block.y.push_back(y_bit(symbol));
        }
    }
    return block;
}

Block damaged(Block block, double missing, double wrong, Rng& rng) {
    for (std::size_t i = 0; i < block.x.size(); ++i) {
        if (rng.uniform() < wrong) block.x[i] ^= 1;
        if (rng.uniform() < wrong) block.y[i] ^= 1;
        if (rng.uniform() < missing) block.x[i] = block.y[i] = -1;
    }
    return block;
}

struct Verdict {
    bool is_certain = false;
    Fix fix;
};

/// Judges the bits as those of a block at `claimed`.
Verdict judge(const Block& block, const Place& claimed, const IntegrityOptions& options = {}) {
    core::BitBlock words;
    core::Evidence evidence;
    evidence.corner = claimed;
    for (int row = 0; row < block.rows; ++row) {
        for (int column = 0; column < block.columns; ++column) {
            const std::size_t i = block.index(column, row);
            if (block.x[i] < 0) continue;
            const Place at = moved(block.profile, claimed, column, row);
            const Symbol symbol = symbol_at(block.profile, at.cell, at.section);
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
    verdict.is_certain =
        core::is_certain(core::kernels(), evidence, block.profile, options, verdict.fix);
    return verdict;
}

/// Returns how many bits of an axis contradict a position whose lines have these rolls.
int contradictions(const Block& block, bool is_x, const std::vector<int>& rolls) {
    int wrong = 0;
    for (int row = 0; row < block.rows; ++row) {
        for (int column = 0; column < block.columns; ++column) {
            const std::size_t i = block.index(column, row);
            const int bit = is_x ? block.x[i] : block.y[i];
            const int line = is_x ? column : row;
            const int along = is_x ? row : column;
            const int roll = rolls[static_cast<std::size_t>(line)];
            wrong +=
                bit >= 0 && bit != code_test::digit_at(code_test::kMainText,
                                                       static_cast<std::uint64_t>(roll + along));
        }
    }
    return wrong;
}

/// Returns the rolls of the lines of an axis, if one sequence is `further` digits ahead of where
/// the position has it and all rolls are larger by `shift`.
std::vector<int> rolls_of(const Block& block, bool is_x, std::size_t sequence, int further,
                          int shift) {
    const Place& p = block.place;
    const std::uint64_t own = is_x ? p.cell.x : p.cell.y;
    const std::uint64_t cross = is_x ? p.cell.y : p.cell.x;
    const auto texts = code_test::secondary_texts(block.profile);
    const int first = code_test::reference_roll(block.profile, own) +
                      (is_x ? p.section.u : p.section.v) + static_cast<int>(cross % 63);
    std::vector<int> rolls{(first + shift) % 63};
    for (int line = 0; line + 1 < (is_x ? block.columns : block.rows); ++line) {
        int delta = 5;
        for (std::size_t n = 0; n < texts.size(); ++n) {
            const std::uint64_t moved_by = n == sequence ? static_cast<std::uint64_t>(further) : 0;
            delta += code_test::kWeights[n] *
                     code_test::digit_at(texts[n], own + moved_by + static_cast<unsigned>(line));
        }
        rolls.push_back((rolls.back() + delta) % 63);
    }
    return rolls;
}

/// Returns log2 of the summed odds, for both axes, of all alternatives that differ in one sequence
/// and share a line, of other sections and of chance, at the odds per bit that the claim uses.
double exact_log2(const Block& block) {
    double sum = 0;
    core::Confidence both;
    std::array<int, 2> errors{};
    int read = 0;
    for (const bool is_x : {true, false}) {
        const int wrong = contradictions(block, is_x, rolls_of(block, is_x, 0, 0, 0));
        errors[is_x ? 0 : 1] = wrong;
        read = static_cast<int>(std::ranges::count_if(block.x, [](int bit) { return bit >= 0; }));
        both.add(127, true, wrong);
        both.add(127, false, read - wrong);
    }
    const double odds_per_bit = core::odds_per_bit_q8(both) / 256.0;
    for (const bool is_x : {true, false}) {
        const int own_wrong = errors[is_x ? 0 : 1];
        // Chance cannot be less probable than the sum over the binomial distribution.
        sum += std::exp2(
            static_cast<double>(exact_chance_log2(read)[static_cast<std::size_t>(own_wrong)]));
        const auto texts = code_test::secondary_texts(block.profile);
        const auto own = rolls_of(block, is_x, 0, 0, 0);
        const auto add = [&](const std::vector<int>& rolls) {
            sum += std::exp2(-odds_per_bit * (contradictions(block, is_x, rolls) - own_wrong));
        };
        for (int shift = 1; shift < 63; ++shift)
            add(rolls_of(block, is_x, 0, 0, shift));
        for (std::size_t n = 0; n < texts.size(); ++n) {
            for (int further = 1; further < static_cast<int>(texts[n].size()); ++further) {
                const auto alternative = rolls_of(block, is_x, n, further, 0);
                std::array<bool, 63> is_shared{};
                for (std::size_t line = 0; line < alternative.size(); ++line)
                    is_shared[static_cast<std::size_t>((own[line] - alternative[line] + 63) % 63)] =
                        true;
                for (int shift = 0; shift < 63; ++shift) {
                    if (is_shared[static_cast<std::size_t>(shift)])
                        add(rolls_of(block, is_x, n, further, shift));
                }
            }
        }
    }
    return std::log2(sum);
}

Place any_place(Rng& rng) {
    return {{rng.below(kPositionsPerAxis), rng.below(kPositionsPerAxis)},
            {static_cast<std::uint8_t>(rng.below(63)), static_cast<std::uint8_t>(rng.below(63))}};
}

Block random_block(Rng& rng, int i, double most_missing, double most_wrong) {
    const auto side = [&] { return 8 + static_cast<int>(rng.below(12)); };
    return damaged(cut_block(code_test::kProfiles[static_cast<std::size_t>(i % 3)], any_place(rng),
                             side(), side()),
                   rng.uniform(0, most_missing), rng.uniform(0, most_wrong), rng);
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
        const Block block = cut_block(code_test::kProfiles[static_cast<std::size_t>(i % 3)],
                                      any_place(rng), 14, 13);
        const Verdict verdict = judge(block, block.place);
        EXPECT_TRUE(verdict.is_certain);
        EXPECT_EQ(verdict.fix.bit_errors, 0);
    }
}

/// Returns bits between two alternatives: in columns in which they differ, half of the bits that
/// tell them apart are those of the alternative, so that both explain the view equally well.
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
        const Block block = cut_block(code_test::kProfiles[static_cast<std::size_t>(i % 3)],
                                      any_place(rng), 11, 12);
        const auto own = rolls_of(block, true, 0, 0, 0);
        // The worst alternative is the one that differs in the fewest bits.
        std::vector<int> worst;
        int fewest = INT32_MAX;
        const auto texts = code_test::secondary_texts(block.profile);
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
        // The number of errors alone must not be the reason for a refusal.
        options.max_bit_error_q8 = 256;
        without_errors += judge(block, block.place, options).is_certain;
        EXPECT_FALSE(judge(between(block, own, worst), block.place, options).is_certain);
    }
    EXPECT_GE(without_errors, 20);
}

/// Judges the bits alone, as those of a block at `claimed`.
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
        const auto read = std::ranges::count_if(block.x, [](int bit) { return bit >= 0; });
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
    const Place middle = moved(block.profile, claimed, -first_column, -first_row);
    const core::CodedBlock coded(block.profile, middle, view, words);
    Verdict verdict;
    verdict.is_certain = core::is_plainly_certain(
        core::kernels(),
        {coded.axis(core::Axis::x, confidences[0]), coded.axis(core::Axis::y, confidences[1])},
        block.profile, options, verdict.fix);
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
        const Block block = cut_block(code_test::kProfiles[static_cast<std::size_t>(i % 3)],
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
        if (i % 4 == 1) wrong = moved(block.profile, wrong, 1, 0);
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
        Block block = cut_block(Profile::anoto, any_place(rng), 16, 16);
        alone += judge_plainly(block, block.place).is_certain;
        // Most columns show another section.
        Place other = block.place;
        other.section.u = static_cast<std::uint8_t>((other.section.u + 30) % 63);
        const Block beyond = cut_block(Profile::anoto, other, 16, 16);
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

TEST(IsCertain, RefusesWrongPlaces) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "block " << i << ", seed " << kSeed);
        const Block block = random_block(rng, i, 0.1, 0.02);
        Place wrong = block.place;
        if (i % 5 == 0) wrong = any_place(rng);
        if (i % 5 == 1) wrong = moved(block.profile, wrong, 1, 0);
        if (i % 5 == 2) wrong = moved(block.profile, wrong, 0, -1);
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
            damaged(cut_block(Profile::anoto, any_place(rng), 30, 30), 0, 0.25, rng);
        IntegrityOptions options;
        options.max_p_wrong_log2 = 0;
        EXPECT_FALSE(judge(block, block.place, options).is_certain) << i << ", seed " << kSeed;
    }
}

/// Returns what `verify` says of the same bits.
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
    verdict.is_certain =
        core::verify(grid, block.profile, decoding, options, storage, verdict.fix) == Status::ok;
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
        // What is certain here is certain there, apart from roundings.
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
}  // namespace dotpose::core_test

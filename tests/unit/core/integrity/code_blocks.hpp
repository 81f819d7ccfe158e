// Blocks of cells cut out of the code, with random bit errors and missing bits, and exact sums over
// the alternatives to the place of a block.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../code/reference.hpp"
#include "chance.hpp"
#include "core/integrity/confidence.hpp"
#include "dotpose/code.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test {

/// Bits of a block of the code, starting at `place`. Each element is 0 or 1, or -1 if the bit was
/// not read.
struct Block {
    CodeVariant code;
    Place place;
    int columns;
    int rows;
    std::vector<int> x;
    std::vector<int> y;

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row * columns + column);
    }
};

inline Block cut_block(CodeVariant code, const Place& place, int columns, int rows) {
    Block block{code, place, columns, rows, {}, {}};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const Place at = moved(code, place, column, row);
            const Symbol symbol = symbol_at(code, at.cell, at.section);
            block.x.push_back(x_bit(symbol));
            block.y.push_back(y_bit(symbol));
        }
    }
    return block;
}

inline Block damaged(Block block, double missing, double wrong, Rng& rng) {
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

/// Returns the number of bits along an axis that disagree with the code if the lines of this axis
/// have the given rolls.
inline int contradictions(const Block& block, bool is_x, const std::vector<int>& rolls) {
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

/// Returns the rolls of the lines of an axis if one sequence is advanced by `further` digits and
/// all rolls are increased by `shift`.
inline std::vector<int> rolls_of(const Block& block, bool is_x, std::size_t sequence, int further,
                                 int shift) {
    const Place& p = block.place;
    const std::uint64_t own = is_x ? p.cell.x : p.cell.y;
    const std::uint64_t cross = is_x ? p.cell.y : p.cell.x;
    const auto texts = code_test::secondary_texts(block.code);
    const int first = code_test::reference_roll(block.code, own) +
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

/// Returns log2 of the sum that the verdict bounds, computed exactly. For each axis, the sum
/// contains the probability of a match by chance and the odds of the alternatives. There are two
/// kinds of alternatives: other sections, and positions that differ in one sequence but share at
/// least one line with the true position. The odds per bit are computed as in the verdict.
inline double exact_log2(const Block& block) {
    double sum = 0;
    core::Confidence both;
    std::array<int, 2> errors{};
    int read = 0;
    for (const bool is_x : {true, false}) {
        const int wrong = contradictions(block, is_x, rolls_of(block, is_x, 0, 0, 0));
        errors[is_x ? 0 : 1] = wrong;
        read = static_cast<int>(
            std::count_if(block.x.begin(), block.x.end(), [](int bit) { return bit >= 0; }));
        both.add(127, true, wrong);
        both.add(127, false, read - wrong);
    }
    const double odds_per_bit = core::odds_per_bit_q8(both) / 256.0;
    for (const bool is_x : {true, false}) {
        const int own_wrong = errors[is_x ? 0 : 1];
        // The verdict must not underestimate the exact probability of a match by chance.
        sum += std::exp2(
            static_cast<double>(exact_chance_log2(read)[static_cast<std::size_t>(own_wrong)]));
        const auto texts = code_test::secondary_texts(block.code);
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

inline Place any_place(Rng& rng) {
    return {{rng.below(kPositionsPerAxis), rng.below(kPositionsPerAxis)},
            {static_cast<std::uint8_t>(rng.below(63)), static_cast<std::uint8_t>(rng.below(63))}};
}

inline Block random_block(Rng& rng, int i, double max_missing, double max_wrong) {
    const auto side = [&] { return 8 + static_cast<int>(rng.below(12)); };
    return damaged(cut_block(code_test::kCodeVariants[static_cast<std::size_t>(i % 3)],
                             any_place(rng), side(), side()),
                   rng.uniform(0, max_missing), rng.uniform(0, max_wrong), rng);
}

}  // namespace dotpose::core_test

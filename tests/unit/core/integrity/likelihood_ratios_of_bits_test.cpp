// Tests the likelihood ratios of hard bits. They must equal the ratios of scored lines whose bits
// all have weight 127. Estimated sums of likelihood ratios must not be smaller than the exact sums.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "code/rolls.hpp"
#include "code/tables.hpp"
#include "core/integrity/alternative_sets.hpp"
#include "core/integrity/likelihood_ratios.hpp"
#include "core/integrity/quick_alternatives.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/math/fixed.hpp"
#include "dotpose/tools/random.hpp"
#include "locate/workspace.hpp"
#include "single_odds.hpp"

namespace dotpose::core_test::likelihood_ratios_of_bits_test {
namespace {

using namespace core;

constexpr int kOdds_q8 = 7 * 256;
constexpr int kLines = 17;
constexpr int kLength = 11;

/// Columns of the code at a random position, as bits and as weights.
struct Columns {
    explicit Columns(Rng& rng) {
        reading.position = static_cast<std::uint32_t>(rng.below(kPositionsPerAxis - 100));
        reading.roll = static_cast<std::uint8_t>(rng.below(kSections));
        std::array<std::uint8_t, kLines> rolls;
        code::follow_rolls(CodeVariant::anoto, reading.position, reading.roll, rolls);
        workspace->grid.columns = kLines;
        workspace->grid.rows = kLength;
        const int lost = static_cast<int>(rng.below(4));
        for (int i = 0; i < kLines; ++i) {
            ComparedLine& line = lines[static_cast<std::size_t>(i)];
            line.code = code::kMainWords[rolls[static_cast<std::size_t>(i)]];
            for (int j = 0; j < kLength; ++j) {
                const std::uint32_t bit = std::uint32_t{1} << j;
                // The cells in the corners of the block are not in view, as in a rotated frame.
                const bool is_in_view = i + j > 3 && i + j < kLines + kLength - 6;
                const bool is_seen = is_in_view && rng.below(40) >= static_cast<unsigned>(lost);
                const bool is_wrong = is_seen && rng.below(60) < static_cast<unsigned>(lost);
                if (is_seen) line.seen |= bit;
                if (is_wrong) line.wrong |= bit;
                const bool read = ((line.code & bit) != 0) != is_wrong;
                GridCell& cell = workspace->grid.at(i, j);
                cell = {};
                if (is_seen) cell.x = read ? 127 : -127;
            }
        }
    }
    LikelihoodRatios of_bits() const { return {CodeVariant::anoto, lines, reading, kOdds_q8}; }
    LikelihoodRatios of_weights() {
        const Upright upright(workspace->grid, {0, 0, kLines, kLength}, {});
        return {CodeVariant::anoto, score_lines(upright, Axis::x, workspace->line_scores), reading,
                kOdds_q8};
    }

    AxisReading reading;
    std::array<ComparedLine, kLines> lines{};
    std::unique_ptr<SmallWorkspace> workspace = std::make_unique<SmallWorkspace>();
};

TEST(LikelihoodRatiosOfBits, LosesAsWeightsDo) {
    Rng rng(8);
    for (int round = 0; round < 200; ++round) {
        Columns columns(rng);
        const LikelihoodRatios bits = columns.of_bits();
        const LikelihoodRatios weights = columns.of_weights();
        ASSERT_EQ(bits.count(), weights.count());
        for (int line = 0; line < kLines; ++line) {
            ASSERT_EQ(bits.own_roll(line), weights.own_roll(line));
            double sum = 0;
            for (int shift = 1 - kSections; shift < kSections; ++shift) {
                ASSERT_EQ(bits.loss(line, shift), weights.loss(line, shift)) << line;
                if (shift > 0) sum += std::exp2(bits.log2_odds_q8(bits.loss(line, shift)) / 256.0);
            }
            ASSERT_EQ(bits.min_loss(line), weights.min_loss(line)) << line;
            const double bound = std::exp2(
                (bits.log2_odds_q8(bits.min_loss(line)) + bits.log2_of_nearest_q8(line)) / 256.0);
            ASSERT_LE(sum, bound) << line;
            ASSERT_LE(bound, 64 * sum) << line;
        }
        EXPECT_EQ(bits.max_gain(), weights.max_gain());
        RollOffsets offsets;
        set_roll_offsets(bits, 2, (bits.places[2] + 1) % bits.basis[2].length, offsets);
        for (int line = 0; line < kLines; ++line)
            EXPECT_EQ(loss_of_offsets(bits, offsets, line),
                      loss_of_offsets(weights, offsets, line));
    }
}

/// The estimate must be an upper bound, whether it comes from tables or from an enumeration of
/// alternatives.
TEST(LikelihoodRatiosOfBits, EstimatesNoLessThanAllSingleAlternatives) {
    Rng rng(12);
    int told = 0;
    for (int round = 0; round < 200; ++round) {
        const Columns columns(rng);
        const LikelihoodRatios ratios = columns.of_bits();
        const double expected = single_odds(ratios);
        for (const int limit : {0, -20, -30}) {
            const int estimate_q8 = quick_alternatives_log2_q8(ratios, 256 * limit);
            if (estimate_q8 == 0) continue;
            ++told;
            EXPECT_GE(std::exp2(estimate_q8 / 256.0), expected) << round << ", limit " << limit;
        }
    }
    EXPECT_GT(told, 100);
}

/// Computes the expected odds of one set of far alternatives (docs/integrity.md, "The quick bound")
/// in double precision. The result is the sum of two parts: the odds of alternatives that share a
/// run of lines with the reading, and the odds of all other alternatives.
double far_odds(const LikelihoodRatios& ratios, const AlternativeSet& set) {
    const auto power = [](int log2_q8) { return std::exp2(log2_q8 / 256.0); };
    const double equal = power(set.equal_q8 + kUnevenness_q8);
    std::vector<double> sharing{1};
    double apart = 0;
    double sum = 0;
    for (int line = 0; line < ratios.count(); ++line) {
        const double best = power(ratios.log2_odds_q8(ratios.min_loss(line)));
        const double all = best * power(ratios.log2_of_nearest_q8(line));
        if (line > 0) {
            for (double& odds : sharing)
                odds *= equal;
            sharing.push_back(apart * equal);
        }
        apart = line == 0 ? all : sum * std::min(best * power(kUnevenness_q8), all * equal);
        const auto most = std::min(sharing.size(), static_cast<std::size_t>(ratios.max_shared()));
        sum = std::accumulate(sharing.end() - static_cast<std::ptrdiff_t>(most), sharing.end(),
                              apart);
    }
    return sum * power(set.alternatives_q8);
}

/// The estimate must be an upper bound, however certain the reading is and whatever the limit is.
/// With 6 to 9 lines, all sets have about equal odds, so a missing set would be noticed.
TEST(LikelihoodRatiosOfBits, EstimatesNoLessThanAllSetsOfFarAlternatives) {
    Rng rng(11);
    int doubtful = 0;
    for (int round = 0; round < 400; ++round) {
        const Columns columns(rng);
        std::array<ComparedLine, kLines> lines = columns.lines;
        const std::uint32_t seen = (std::uint32_t{1} << (12 + rng.below(18))) - 1;
        for (ComparedLine& line : lines)
            line = {line.code, seen, 0};
        const LikelihoodRatios ratios(CodeVariant::anoto, std::span(lines).first(6 + rng.below(4)),
                                      columns.reading, kOdds_q8);
        double expected = 0;
        for (const AlternativeSet& set : kAlternativeSets)
            expected += far_odds(ratios, set);
        for (const int limit : {0, -20, -30}) {
            const int estimate_q8 = quick_alternatives_log2_q8(ratios, 256 * limit);
            if (estimate_q8 == 0) continue;
            doubtful += estimate_q8 > -36 * 256 ? 1 : 0;
            EXPECT_GE(std::exp2(estimate_q8 / 256.0), expected) << round << ", limit " << limit;
        }
    }
    EXPECT_GT(doubtful, 100);
}

/// If the table contains a minimum loss for the alternatives in a sequence, each of these
/// alternatives must lose at least as much.
TEST(UnsharedLines, AreNotSharedByAnyAlternative) {
    Rng rng(10);
    int known = 0;
    for (int round = 0; round < 60; ++round) {
        Columns columns(rng);
        const LikelihoodRatios ratios = columns.of_bits();
        const UnsharedLines unshared(ratios);
        for (std::size_t k = 0; k < 4; ++k) {
            constexpr int kEnough = 5 * 254;
            if (!unshared.all_lose(k, Sharing::at_one_shift, kEnough)) continue;
            ++known;
            visit_single_alternatives(
                ratios, k, [&](std::uint32_t place, const RollOffsets& offsets, int shift) {
                    int lost = 0;
                    for (int line = 0; line < kLines; ++line) {
                        const bool is_shared = offsets[static_cast<std::size_t>(line)] == shift;
                        lost += is_shared ? 0 : std::max(ratios.min_loss(line), 0);
                    }
                    ASSERT_GE(lost, kEnough) << k << ' ' << place << ' ' << shift;
                });
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_GT(known, 20);
}

}  // namespace
}  // namespace dotpose::core_test::likelihood_ratios_of_bits_test

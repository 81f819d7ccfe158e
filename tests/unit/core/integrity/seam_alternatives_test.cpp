// Tests the odds of seam alternatives, which have different shifts on the two sides of a border,
// against a double-precision sum over all places, borders and shifts.
#include "core/integrity/seam_alternatives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/kernels/select.hpp"
#include "ratios_case.hpp"

namespace dotpose::core_test::seam_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 57;
constexpr double kSeamLog2 = -32;
constexpr double kMinLog2 = -8;

/// A place in a sequence, and its roll offset from the reading for each line.
struct Alternative {
    std::size_t sequence;
    std::size_t place;
    std::vector<int> offsets;
};

int modulo_63(int n) {
    return (n % 63 + 63) % 63;
}

std::vector<Alternative> all_alternatives(const RatiosCase& c) {
    std::vector<Alternative> alternatives;
    const auto texts = code_test::secondary_texts(c.code);
    for (std::size_t k = 0; k < texts.size(); ++k) {
        const std::size_t length = texts[k].size();
        for (std::size_t place = 0; place < length; ++place) {
            if (place == c.position % length) continue;
            Alternative alternative{k, place, {0}};
            for (std::size_t line = 0; line + 1 < c.rolls.size(); ++line) {
                const int step = code_test::digit_at(texts[k], place + line) -
                                 code_test::digit_at(texts[k], c.position % length + line);
                alternative.offsets.push_back(
                    modulo_63(alternative.offsets.back() + code_test::kWeights[k] * step));
            }
            alternatives.push_back(alternative);
        }
    }
    return alternatives;
}

/// Returns the minimum loss of an alternative in the lines [first, end), over the shifts at which
/// the alternative shares a line with the reading. The loss is the score of the reading minus the
/// score of the alternative.
double min_loss(const RatiosCase& c, const Alternative& alternative, std::size_t first,
                std::size_t end) {
    double least = std::numeric_limits<double>::infinity();
    for (const int shared : alternative.offsets) {
        double lost = 0;
        for (std::size_t line = first; line < end; ++line) {
            const int own = c.rolls[line];
            const int other = modulo_63(own + alternative.offsets[line] - shared);
            lost += c.storage[line].scores[static_cast<std::size_t>(own)] -
                    c.storage[line].scores[static_cast<std::size_t>(other)];
        }
        least = std::min(least, lost);
    }
    return least;
}

struct Sum {
    double odds = 0;
    int terms = 0;
};

/// Returns the sum of the odds of all alternatives at all borders. Alternatives are excluded if
/// their odds, without the prior probability of a seam, are at most 2^kMinLog2.
Sum sum_of_all(const RatiosCase& c) {
    Sum sum;
    for (const Alternative& alternative : all_alternatives(c)) {
        for (std::size_t border = 1; border < c.rolls.size(); ++border) {
            const double lost = min_loss(c, alternative, 0, border) +
                                min_loss(c, alternative, border, c.rolls.size());
            // The loss is halved, because each bit that disagrees only with the alternative reduces
            // the score by twice its weight.
            const double odds = -lost / 2 / 127 * c.odds_q8 / 256;
            if (odds <= kMinLog2) continue;
            sum.odds += std::exp2(odds + kSeamLog2);
            ++sum.terms;
        }
    }
    return sum;
}

/// Returns lines of 10 to 16 bits each. All bits are correct.
RatiosCase clear_lines(Rng& rng, int lines) {
    RatiosCase c = at_random_place(rng, lines);
    for (const int own : c.rolls)
        c.storage.push_back(scored_line(own, 10 + static_cast<int>(rng.below(7)), 0, 127, rng));
    c.odds_q8 = 7 * 256;
    return c;
}

TEST(SeamAlternatives, AreAllThatExplainTheLinesAboutAsWell) {
    Rng rng(kSeed);
    int some = 0;
    int no_terms = 0;
    int unfinished = 0;
    for (int i = 0; i < 250; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        RatiosCase c = at_random_place(rng, 6 + static_cast<int>(rng.below(12)));
        const double wrong = rng.uniform(0, 0.1);
        for (const int own : c.rolls) {
            // Some lines have only 3 bits, or bits that belong to a random roll.
            const int shown = rng.below(15) == 0 ? static_cast<int>(rng.below(63)) : own;
            const int bits = rng.below(3) == 0 ? 3 : 6 + static_cast<int>(rng.below(10));
            c.storage.push_back(scored_line(shown, bits, wrong, 127, rng));
        }
        c.odds_q8 = static_cast<int>(256 * rng.uniform(2, 8));
        // Because of rounding, odds at the limit may or may not be counted.
        const double limit = std::exp2(kSeamLog2 + kMinLog2);
        const LikelihoodRatios ratios = c.ratios();
        const int counted_q8 = seam_alternatives_log2_q8(ratios);
        const double counted = std::exp2(counted_q8 / 256.0);
        const Kernels& desktop = kernels();
        const UnsharedLines unshared(desktop, ratios);
        EXPECT_EQ(seam_alternatives_log2_q8(desktop, unshared), counted_q8);
        WorkLimit none(0);
        const auto without_work = seam_alternatives_log2_q8(desktop, unshared, none);
        EXPECT_TRUE(!without_work || *without_work == counted_q8);
        unfinished += without_work ? 0 : 1;
        const Sum sum = sum_of_all(c);
        const double log2_ratio = std::log2((counted + limit) / (sum.odds + limit));
        EXPECT_GE(log2_ratio, -0.1);
        // Every addition rounds log2 of the sum up by at most 0.012.
        EXPECT_LE(log2_ratio, 0.1 + sum.terms * 0.012);
        ++(sum.terms > 0 ? some : no_terms);
    }
    EXPECT_GE(some, 30) << "seed " << kSeed;
    EXPECT_GE(no_terms, 30) << "seed " << kSeed;
    EXPECT_GE(unfinished, some) << "seed " << kSeed;
}

TEST(SeamAlternatives, ASeamExplainsTenLinesAsWell) {
    // The alternatives that are counted here have the rolls of the reading on one side of the
    // border, and these rolls plus a constant shift on the other side. If there is a seam at the
    // border, such an alternative explains all ten lines as well as the reading does.
    constexpr std::size_t kLines = 10;
    constexpr std::size_t kBorder = 5;
    Rng rng(kSeed);
    int seams = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        const RatiosCase c = clear_lines(rng, kLines);
        const std::vector<Alternative> alternatives = all_alternatives(c);
        const auto count = std::count_if(
            alternatives.begin(), alternatives.end(), [&](const Alternative& alternative) {
                return std::count(alternative.offsets.begin(),
                                  alternative.offsets.begin() + kBorder, 0) == kBorder &&
                       std::count(alternative.offsets.begin() + kBorder, alternative.offsets.end(),
                                  alternative.offsets.back()) == kLines - kBorder;
            });
        if (count == 0 || c.code == CodeVariant::libdots) continue;
        ++seams;
        EXPECT_NEAR(seam_alternatives_log2_q8(c.ratios()) / 256.0,
                    kSeamLog2 + std::log2(static_cast<double>(count)), 0.1);
    }
    EXPECT_GE(seams, 10) << "seed " << kSeed;
}

TEST(SeamAlternatives, NoneExplainsManyClearLines) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        const RatiosCase c = clear_lines(rng, 16 + static_cast<int>(rng.below(49)));
        EXPECT_EQ(seam_alternatives_log2_q8(c.ratios()), kNever_q8);
    }
}

TEST(SeamAlternatives, WhatTheLinesShowBetterIsDoubt) {
    // The bits are those of an alternative with a seam. On each side of the border, five lines of
    // the alternative differ from the reading only by a constant shift. Therefore, only the first
    // and the last line show that the reading is wrong.
    Rng rng(kSeed);
    int shown = 0;
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        RatiosCase c = at_random_place(rng, 12);
        c.odds_q8 = 5 * 256;
        for (const Alternative& alternative : all_alternatives(c)) {
            const auto shares = [&](std::ptrdiff_t first) {
                const auto begin = alternative.offsets.begin() + first;
                return std::count(begin, begin + 5, *begin) == 5;
            };
            if (!shares(1) || !shares(6)) continue;
            for (std::size_t line = 0; line < c.rolls.size(); ++line) {
                const int shift = alternative.offsets[line] - alternative.offsets[line < 6 ? 1 : 6];
                c.storage.push_back(scored_line(modulo_63(c.rolls[line] + shift), 12, 0, 127, rng));
            }
            const double gained =
                -(min_loss(c, alternative, 0, 6) + min_loss(c, alternative, 6, 12)) / 2 / 127 * 5;
            EXPECT_GE(seam_alternatives_log2_q8(c.ratios()) / 256.0, kSeamLog2 + gained - 0.1);
            shown += gained > 5;
            break;
        }
    }
    EXPECT_GE(shown, 10) << "seed " << kSeed;
}

}  // namespace
}  // namespace dotpose::core_test::seam_alternatives_test

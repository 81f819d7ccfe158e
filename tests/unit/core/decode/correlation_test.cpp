// Tests the weighted correlation of bits with the main sequence (paper, section II-B.7) against a
// brute-force sum over the digits of the sequence.
#include "core/decode/correlation.hpp"

#include <gtest/gtest.h>

#include "../../code/reference.hpp"
#include "../geometry.hpp"

namespace dotpose::core_test::correlation_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 30;

TEST(Correlation, IsWhatAgreesMinusWhatDoesNot) {
    Rng rng(kSeed);
    for (int length = 1; length <= 256; ++length) {
        std::vector<std::int8_t> weights;
        for (int i = 0; i < length; ++i) {
            const int weight = static_cast<int>(rng.below(128));
            weights.push_back(static_cast<std::int8_t>(rng.below(2) == 0 ? weight : -weight));
        }
        LineScores scores;
        correlate(weights, scores);
        for (std::size_t o = 0; o < 63; ++o) {
            int expected = 0;
            for (std::size_t i = 0; i < weights.size(); ++i) {
                expected += code_test::digit_at(code_test::kMainText, o + i) == 1 ? weights[i]
                                                                                  : -weights[i];
            }
            ASSERT_EQ(scores[o], expected)
                << length << " weights, offset " << o << ", seed " << kSeed;
        }
        const Match match = best_match(scores);
        const auto best = std::max_element(scores.begin(), scores.end());
        EXPECT_EQ(match.score, *best);
        EXPECT_EQ(match.roll, best - scores.begin());
        const Extremes extremes = extremes_of(scores);
        EXPECT_EQ(extremes.max, *best);
        EXPECT_EQ(extremes.min, *std::min_element(scores.begin(), scores.end()));
    }
}

TEST(Correlation, LinesOfTheSequenceAgreeWithItWholly) {
    LineScores scores;
    for (std::size_t roll = 0; roll < 63; ++roll) {
        for (const std::size_t length : {6U, 8U, 70U, 256U}) {
            std::vector<std::int8_t> line;
            for (std::size_t i = 0; i < length; ++i) {
                line.push_back(code_test::digit_at(code_test::kMainText, roll + i) == 1 ? 127
                                                                                        : -127);
            }
            correlate(line, scores);
            EXPECT_EQ(best_match(scores).roll, roll);
            EXPECT_EQ(best_match(scores).score, 127 * static_cast<int>(length));
        }
    }
}

TEST(Correlation, ContradictionIsMeasuredLikeAgreement) {
    // The magnitude of a sum is largest if all 256 cells disagree with the sequence, each with the
    // maximum weight.
    LineScores scores;
    for (std::size_t roll = 0; roll < 63; ++roll) {
        std::vector<std::int8_t> line;
        for (std::size_t i = 0; i < 256; ++i)
            line.push_back(code_test::digit_at(code_test::kMainText, roll + i) == 1 ? -127 : 127);
        correlate(line, scores);
        EXPECT_EQ(scores[roll], -127 * 256);
    }
}

TEST(Correlation, OfEqualsTheFirstIsTaken) {
    LineScores scores;
    correlate({}, scores);
    EXPECT_EQ(best_match(scores).roll, 0);
    EXPECT_EQ(best_match(scores).score, 0);
}

TEST(Correlation, TheLeadIsThatOverTheSecondBest) {
    Rng rng(kSeed);
    for (int i = 0; i < 2000; ++i) {
        LineScores scores;
        const std::uint32_t range = i % 2 == 0 ? 20 : 60000;
        for (std::int16_t& score : scores) {
            score = static_cast<std::int16_t>(static_cast<int>(rng.below(range)) - 30000);
        }
        const BestScore best = best_score(scores);
        std::sort(scores.begin(), scores.end());
        ASSERT_EQ(best.score, scores[62]) << i << ", seed " << kSeed;
        if (scores[62] - scores[61] <= INT16_MAX) {
            ASSERT_EQ(best.margin, scores[62] - scores[61]) << i << ", seed " << kSeed;
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::correlation_test

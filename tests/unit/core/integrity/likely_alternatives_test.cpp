// Tests sum_of_likely_alternatives with lines that agree with the reading and, almost as well, with
// one alternative. All other positions have much smaller odds.
#include "core/integrity/likely_alternatives.hpp"

#include <bit>
#include <optional>

#include <gtest/gtest.h>

#include "code/basis.hpp"
#include "core/kernels/select.hpp"
#include "ratios_case.hpp"

namespace dotpose::core_test::likely_alternatives_test {
namespace {

constexpr std::uint64_t kSeed = 61;
constexpr int kLines = 11;
constexpr float kMaxRest = 0x1p-16F;

/// Returns another place in a sequence, whose digits equal those of the place `own` at three or
/// more steps, if there is such a place.
std::uint32_t similar_place(const std::string_view text, std::uint32_t own, Rng& rng) {
    const auto length = static_cast<std::uint32_t>(text.size());
    const std::uint32_t first = rng.below(length);
    std::uint32_t most_similar = own;
    int most = -1;
    for (std::uint32_t n = 0; n < length; ++n) {
        const std::uint32_t place = (first + n) % length;
        if (place == own) continue;
        int equal = 0;
        for (std::uint32_t step = 3; step < 7; ++step)
            equal += text[(place + step) % length] == text[(own + step) % length] ? 1 : 0;
        if (equal > most) {
            most = equal;
            most_similar = place;
        }
    }
    return most_similar;
}

/// Lines that score 1000 at the roll of the reading, 900 at the roll of an alternative, and -2100
/// to -1500 at all other rolls. The alternative differs from the reading in the sequences whose
/// bits in `different` are set.
struct Case {
    Case(Rng& rng, unsigned different) : lines(at_random_place(rng, kLines)) {
        lines.odds_q8 = 3 * 256;
        const auto texts = code_test::secondary_texts(lines.code);
        PlacesOfAlternative places = own_places(lines);
        for (std::size_t k = 0; k < places.size(); ++k) {
            if ((different >> k & 1) != 0) places[k] = similar_place(texts[k], places[k], rng);
        }
        constexpr std::size_t kShared = 3;
        rolls = rolls_from(lines, places, kShared);
        for (std::size_t line = 0; line < kLines; ++line) {
            ScoredLine scored;
            for (std::int16_t& score : scored.scores)
                score = static_cast<std::int16_t>(-1500 - static_cast<int>(rng.below(600)));
            scored.scores[static_cast<std::size_t>(rolls[line])] = 900;
            scored.scores[static_cast<std::size_t>(lines.rolls[line])] = 1000;
            scored.best = best_score(scored.scores);
            lines.storage.push_back(scored);
        }
    }
    RatiosCase lines;
    std::vector<int> rolls;
};

std::optional<float> likely(const RatiosCase& c, float max_rest, float max_odds) {
    const LikelihoodRatios ratios = c.ratios();
    return sum_of_likely_alternatives(kernels(), RankedLines(ratios), max_rest, max_odds);
}

/// Returns the first case in which the search for likely alternatives is short enough to be used.
Case short_case(Rng& rng, unsigned different) {
    for (;;) {
        const Case c(rng, different);
        if (likely(c.lines, kMaxRest, 1)) return c;
    }
}

TEST(LikelyAlternatives, AreFoundIfTheyDifferInTwoOrMoreSequences) {
    Rng rng(kSeed);
    int searched = 0;
    for (int i = 0; i < 10; ++i) {
        for (unsigned different = 0; different < 16; ++different) {
            if (std::popcount(different) < 2) continue;
            const Case c(rng, different);
            const double exact = odds_of_rolls(c.lines, c.rolls);
            const std::optional<float> sum = likely(c.lines, kMaxRest, 1);
            if (!sum) continue;
            ++searched;
            EXPECT_GE(static_cast<double>(*sum), 0.96 * exact) << i << ", " << different;
            EXPECT_LE(static_cast<double>(*sum), 1.04 * exact + static_cast<double>(kMaxRest))
                << i << ", " << different;
        }
    }
    EXPECT_GE(searched, 80) << "of 110, seed " << kSeed;
}

TEST(LikelyAlternatives, DoNotIncludeSingleAlternatives) {
    Rng rng(kSeed);
    for (const unsigned different : {1U, 2U, 4U, 8U}) {
        const Case c = short_case(rng, different);
        ASSERT_GT(odds_of_rolls(c.lines, c.rolls), 0x1p-12);
        const std::optional<float> sum = likely(c.lines, kMaxRest, 1);
        ASSERT_TRUE(sum);
        EXPECT_LT(*sum, 0x1p-13F) << different;
    }
}

TEST(LikelyAlternatives, AreNotFurtherSummedAboveTheMaximum) {
    Rng rng(kSeed);
    const Case c = short_case(rng, 6);
    const std::optional<float> sum = likely(c.lines, kMaxRest, 0x1p-30F);
    ASSERT_TRUE(sum);
    EXPECT_GT(*sum, 0x1p-30F);
}

TEST(LikelyAlternatives, OfLinesWithoutInformationAreTooMany) {
    Rng rng(kSeed);
    Case c(rng, 6);
    for (std::size_t line = 4; line < kLines; ++line)
        c.lines.storage[line] = {};
    const std::optional<float> sum = likely(c.lines, 0x1p-60F, 1);
    EXPECT_TRUE(!sum || *sum > 1);
}

}  // namespace
}  // namespace dotpose::core_test::likely_alternatives_test

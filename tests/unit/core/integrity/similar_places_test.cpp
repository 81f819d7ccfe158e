// Tests SimilarPlaces, which evaluates 32 places at a time, against a reference implementation that
// evaluates one place at a time.
#include "core/integrity/similar_places.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "ratios_case.hpp"

namespace dotpose::core_test::similar_places_test {
namespace {

constexpr std::uint64_t kSeed = 53;

RatiosCase random_case(Rng& rng) {
    RatiosCase c = at_random_place(rng, 6 + static_cast<int>(rng.below(40)));
    const int most = 60 + static_cast<int>(rng.below(68));
    for (const int own : c.rolls) {
        const int bits = static_cast<int>(rng.uniform(3, 14));
        c.storage.push_back(scored_line(own, bits, rng.uniform(0, 0.1), most, rng));
    }
    c.odds_q8 = static_cast<int>(256 * rng.uniform(2, 8));
    return c;
}

/// Returns true if `place` differs from `own` and its loss is less than kLimitParts. If the steps
/// cannot exclude any place, the loss is not tested.
bool is_similar(const code::Secondary& a, std::uint32_t own, std::uint32_t place,
                const Steps& steps) {
    if (place == own) return false;
    if (!steps.can_exclude) return true;
    unsigned lost = 0;
    bool is_counted = false;  // true if the previous step was counted
    for (int step = 0; step < steps.count; ++step) {
        const auto i = static_cast<std::uint32_t>(step);
        const unsigned parts = steps.losses[i];
        const bool differs = a.digit((own + i) % a.length) != a.digit((place + i) % a.length);
        is_counted = parts > 0 && differs && !is_counted;
        if (is_counted) lost += parts;
    }
    return lost < kLimitParts;
}

TEST(SimilarPlaces, AreThoseThatLoseLessThanEnough) {
    Rng rng(kSeed);
    std::size_t found = 0;
    for (int i = 0; i < 300; ++i) {
        const RatiosCase c = random_case(rng);
        const LikelihoodRatios ratios = c.ratios();
        const int enough = ratios.loss_for(-static_cast<int>(rng.below(60 * 256))) + 1;
        const Steps steps(ratios, enough, i % 2 == 0 ? Excused::none : Excused::any_one);
        for (const code::Secondary& a : ratios.basis) {
            const std::uint32_t own = rng.below(a.length);
            const SimilarPlaces similar(a, own, steps);
            for (std::uint32_t word = 0; 32 * word < a.length; ++word) {
                std::uint32_t expected = 0;
                for (std::uint32_t bit = 0; bit < 32 && 32 * word + bit < a.length; ++bit) {
                    if (is_similar(a, own, 32 * word + bit, steps)) expected |= 1U << bit;
                }
                found += expected != 0 ? 1 : 0;
                ASSERT_EQ(similar[word], expected) << i << ", seed " << kSeed;
            }
        }
    }
    EXPECT_GT(found, 100U);
}

TEST(SimilarPlaces, VisitsEachSetBitInOrder) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        PlaceBits places{};
        std::vector<std::uint32_t> expected;
        const std::uint32_t density = 1 + rng.below(64);
        for (std::uint32_t place = 0; place < 32 * places.size(); ++place) {
            if (rng.below(density) != 0) continue;
            places[place / 32] |= 1U << place % 32;
            expected.push_back(place);
        }
        std::vector<std::uint32_t> visited;
        visit_places(places, [&](std::uint32_t place) { visited.push_back(place); });
        ASSERT_EQ(visited, expected) << i << ", seed " << kSeed;
    }
}

TEST(SimilarPlaces, AreVisitedAtTheFirstLine) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        const RatiosCase c = random_case(rng);
        const LikelihoodRatios ratios = c.ratios();
        const Steps steps(ratios, ratios.loss_for(-40 * 256) + 1, Excused::none);
        std::vector<std::pair<std::size_t, std::uint32_t>> expected;
        for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
            const code::Secondary& a = ratios.basis[k];
            const auto ahead = static_cast<std::uint32_t>(steps.first_line);
            const std::uint32_t own = (ratios.places[k] + ahead) % a.length;
            for (std::uint32_t place = 0; place < a.length; ++place) {
                if (is_similar(a, own, (place + ahead) % a.length, steps)) {
                    expected.emplace_back(k, place);
                }
            }
        }
        std::vector<std::pair<std::size_t, std::uint32_t>> visited;
        const auto none = [](std::size_t) { return false; };
        visit_similar_places(ratios, steps, none, [&](std::size_t sequence, std::uint32_t place) {
            visited.emplace_back(sequence, place);
        });
        std::sort(visited.begin(), visited.end());
        ASSERT_EQ(visited, expected) << i << ", seed " << kSeed;
    }
}

}  // namespace
}  // namespace dotpose::core_test::similar_places_test

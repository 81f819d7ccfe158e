// Tests lists of similar places and sums of losses against simple reference computations.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include "core/kernels/kernels.hpp"
#include "random_inputs.hpp"

namespace dotpose::core_test::kernels_alternatives_test {
namespace {

using namespace core;

/// The places of a reading in the four sequences. `offset` compares the rolls of a line at two
/// places in sequence `k`: it returns the roll at `place` minus the roll at the place of the
/// reading, modulo 63.
struct OwnPlaces {
    const code::Basis& basis;
    std::array<std::uint32_t, 4> own;

    explicit OwnPlaces(Rng& rng) : basis(code::basis(static_cast<CodeVariant>(rng.below(3)))) {
        for (std::size_t k = 0; k < own.size(); ++k)
            own[k] = rng.below(basis[k].length);
    }
    int offset(std::size_t k, std::uint32_t place, int line) const {
        return (basis[k].rolls[place + static_cast<std::uint32_t>(line)] -
                basis[k].rolls[own[k] + static_cast<std::uint32_t>(line)] + 63) %
               63;
    }
};

TEST(KernelsAlternatives, SimilarPlacesLoseTooLittleByTheirSteps) {
    int count = 0;
    repeat_with_each_form(50, [&](const Kernels& kernels, Rng& rng) {
        const OwnPlaces places(rng);
        StepLosses steps;
        steps.count = whole(rng, 0, 63);
        for (std::uint8_t& parts : steps.parts)
            parts = static_cast<std::uint8_t>(std::min(whole(rng, 0, 9), StepLosses::kLimitParts));
        for (std::size_t k = 0; k < 4; ++k) {
            const code::Secondary& a = places.basis[k];
            const PlaceBits similar = kernels.find_similar_places(a, places.own[k], steps);
            for (std::uint32_t place = 0; place < 256; ++place) {
                const bool is_similar = (similar[place / 32] >> place % 32 & 1) != 0;
                if (place >= a.length || place == places.own[k]) {
                    ASSERT_FALSE(is_similar);
                    continue;
                }
                // Computes the maximum total loss over all sets of steps. A set contains only steps
                // at which the digits differ, and no two adjacent steps.
                int most = 0;
                int max_before = 0;
                for (int step = 0; step < steps.count; ++step) {
                    const auto at = static_cast<std::uint32_t>(step);
                    const bool differ = a.digit((place + at) % a.length) !=
                                        a.digit((places.own[k] + at) % a.length);
                    const int with_this = max_before + (differ ? steps.parts[at] : 0);
                    max_before = most;
                    most = std::max(most, with_this);
                }
                if (most >= StepLosses::kLimitParts) continue;
                ASSERT_TRUE(is_similar) << k << ' ' << place;
                ++count;
            }
        }
    });
    EXPECT_GT(count, 1000);
}

TEST(KernelsAlternatives, ListHasAllPlacesThatLoseTooLittle) {
    int listed = 0;
    repeat_with_each_form(50, [&](const Kernels& kernels, Rng& rng) {
        const OwnPlaces places(rng);
        std::vector<LineLoss> lines;
        const int count = whole(rng, 8, 40);
        for (int line = 0; line < count; ++line)
            lines.push_back(
                {static_cast<std::uint8_t>(line), static_cast<std::uint8_t>(whole(rng, 1, 4))});
        std::stable_sort(lines.begin(), lines.end(),
                         [](LineLoss a, LineLoss b) { return a.loss > b.loss; });
        const int enough = whole(rng, 4, 14);
        SimilarPlaceList list;
        const auto sequences = static_cast<unsigned>(whole(rng, 1, 15));
        if (!kernels.list_similar_places(places.basis, places.own, sequences, lines, enough, list))
            return;
        // Each element consists of a sequence, a place, and the shift at which the place shares a
        // line with the reading.
        std::set<std::array<int, 3>> found;
        for (const auto& [k, place, line] :
             std::span(list.places).first(static_cast<std::size_t>(list.count)))
            found.insert({k, place, places.offset(k, place, line)});
        for (std::size_t k = 0; k < 4; ++k) {
            if ((sequences >> k & 1) == 0) {
                const auto is_of_it = [&](const auto& alternative) {
                    return alternative[0] == static_cast<int>(k);
                };
                ASSERT_TRUE(std::none_of(found.begin(), found.end(), is_of_it)) << k;
                continue;
            }
            for (std::uint32_t place = 0; place < places.basis[k].length; ++place) {
                if (place == places.own[k]) continue;
                for (int shift = 0; shift < 63; ++shift) {
                    int lost = 0;
                    for (const auto& [line, loss] : lines)
                        lost += places.offset(k, place, line) == shift ? 0 : loss;
                    const std::array<int, 3> alternative{static_cast<int>(k),
                                                         static_cast<int>(place), shift};
                    // The kernel adds up only the losses of lines after the shared line. The list
                    // may therefore also contain places whose total loss exceeds the limit. The
                    // test allows such places.
                    if (lost >= enough) continue;
                    ASSERT_TRUE(found.count(alternative) > 0) << k << ' ' << place << ' ' << shift;
                    ++listed;
                }
            }
        }
    });
    EXPECT_GT(listed, 100);
}

TEST(KernelsAlternatives, ListCountsPlacesFromTheUnlistedLimitOn) {
    int unlisted = 0;
    repeat_with_each_form(50, [&](const Kernels& kernels, Rng& rng) {
        const OwnPlaces places(rng);
        std::vector<LineLoss> lines;
        for (int line = 0; line < 12; ++line)
            lines.push_back({static_cast<std::uint8_t>(line), 5});
        SimilarPlaceList all;
        all.max_count = SimilarPlaceList::kMax;
        ASSERT_TRUE(kernels.list_similar_places(places.basis, places.own, 15, lines, 40, all));
        EXPECT_EQ(all.unlisted_count, 0);
        SimilarPlaceList some = all;
        some.unlisted_limit = whole(rng, 20, 40);
        ASSERT_TRUE(kernels.list_similar_places(places.basis, places.own, 15, lines, 40, some));
        std::vector<std::array<int, 3>> expected;
        for (const auto& [k, place, line] :
             std::span(all.places).first(static_cast<std::size_t>(all.count))) {
            // With eight reference lines, the lower bound is the loss in all lines.
            const int shift = places.offset(k, place, line);
            int lost = 0;
            for (const auto& [other, loss] : lines)
                lost += places.offset(k, place, other) == shift ? 0 : loss;
            if (lost < some.unlisted_limit) expected.push_back({k, place, line});
        }
        std::vector<std::array<int, 3>> listed;
        for (const auto& [k, place, line] :
             std::span(some.places).first(static_cast<std::size_t>(some.count)))
            listed.push_back({k, place, line});
        EXPECT_EQ(listed, expected);
        EXPECT_EQ(some.count + some.unlisted_count, all.count);
        unlisted += some.unlisted_count;
    });
    EXPECT_GT(unlisted, 1000);
}

TEST(KernelsAlternatives, LeastLossesAreThoseOfSortedLosses) {
    repeat_with_each_form(50, [&](const Kernels& kernels, Rng& rng) {
        // In half of the rounds, losses are limited to the range from -1 to 3, so that some losses
        // are equal.
        const int most = whole(rng, 0, 1) == 0 ? 3 : INT16_MAX;
        std::vector<std::int16_t> losses;
        const int count = whole(rng, 8, 16);
        for (int line = 0; line < count; ++line)
            losses.push_back(static_cast<std::int16_t>(whole(rng, -most / 2, most)));
        SmallestSums sums;
        kernels.sum_smallest_losses(losses, sums);
        std::sort(losses.begin(), losses.end());
        int expected = 0;
        ASSERT_EQ(sums[0], 0);
        for (std::size_t n = 1; n < sums.size(); ++n) {
            expected += std::max<int>(losses[n - 1], 0);
            ASSERT_EQ(sums[n], expected) << n;
        }
    });
}

}  // namespace
}  // namespace dotpose::core_test::kernels_alternatives_test

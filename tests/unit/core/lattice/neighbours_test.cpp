// Tests seeds, neighbours and symmetric edges against an exhaustive search.
#include "core/lattice/neighbours.hpp"

#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "../geometry.hpp"

namespace dotpose::core_test::neighbours_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 24;
using Table = std::vector<std::array<std::int16_t, 4>>;

std::vector<std::uint16_t> all_of(const std::vector<DetectedDot>& dots) {
    std::vector<std::uint16_t> seeds(dots.size());
    std::iota(seeds.begin(), seeds.end(), std::uint16_t{0});
    return seeds;
}

std::int64_t squared_distance(const DetectedDot& a, const DetectedDot& b) {
    const std::int64_t x = a.centre_q8.x - b.centre_q8.x;
    const std::int64_t y = a.centre_q8.y - b.centre_q8.y;
    return x * x + y * y;
}

/// Returns true if two dots are less than 128 px apart along each axis, as neighbours must be. No
/// grid has cells as large as this.
bool may_be_neighbours(const DetectedDot& a, const DetectedDot& b) {
    const std::int32_t x = std::abs(a.centre_q8.x - b.centre_q8.x);
    const std::int32_t y = std::abs(a.centre_q8.y - b.centre_q8.y);
    return std::max(x, y) < 128 * 256;
}

constexpr int kKinds = 6;

/// Returns points of one kind: 0 for scattered points, 1 for clumps, 2 for a line, 3 for a grid, 4
/// for partly coincident points, and 5 for a grid whose last point is alone in its row if `count`
/// is the maximum.
std::vector<DetectedDot> points(Rng& rng, int count, int kind) {
    std::vector<DetectedDot> dots;
    for (int i = 0; i < count; ++i) {
        Vec2 p{rng.uniform(0, 187), rng.uniform(0, 119)};
        if (kind == 1) p = {10.0 * (i % 3) + rng.uniform(), 600.0 * (i % 2) + rng.uniform()};
        if (kind == 2) p = {11.0 * i, 3.0 * i};
        if (kind == 3) p = {11.0 * (i % 16), 11.0 * (i / 16)};
        if (kind == 4 && i % 5 == 4) p = real(dots[static_cast<std::size_t>(i - 1)].centre_q8, 8);
        if (kind == 5) p = {11.0 * (i % 17), 16.0 * (i / 17)};
        dots.push_back(dot_at(p));
    }
    return dots;
}

TEST(Neighbours, AreTheFourNearestOfAll) {
    Rng rng(kSeed);
    for (int set = 0; set < 300; ++set) {
        const bool is_full = set % 4 == 3;
        const int count = is_full    ? kMaxSeeds
                          : set < 10 ? set + 1
                                     : 1 + static_cast<int>(rng.below(kMaxSeeds));
        const auto dots = points(rng, count, set % kKinds);
        // Seeds are some of the dots, in random order.
        auto seeds = all_of(dots);
        for (std::size_t i = seeds.size(); i > 1; --i) {
            std::swap(seeds[i - 1], seeds[rng.below(static_cast<std::uint32_t>(i))]);
        }
        if (seeds.size() > 40 && !is_full) seeds.resize(seeds.size() - 20);
        Table found(seeds.size());
        std::vector<BucketedSeed> memory(seeds.size() + 1);
        find_neighbours(dots, seeds, memory, found);
        for (std::size_t s = 0; s < seeds.size(); ++s) {
            std::vector<std::int64_t> expected;
            for (std::size_t t = 0; t < seeds.size(); ++t) {
                const DetectedDot& a = dots[seeds[s]];
                const DetectedDot& b = dots[seeds[t]];
                if (t != s && may_be_neighbours(a, b)) expected.push_back(squared_distance(a, b));
            }
            std::sort(expected.begin(), expected.end());
            std::set<std::int16_t> different;
            for (std::size_t n = 0; n < 4; ++n) {
                SCOPED_TRACE(testing::Message()
                             << "set " << set << ", seed " << kSeed << ", dot " << s);
                const std::int16_t neighbour = found[s][n];
                if (n >= expected.size()) {
                    ASSERT_EQ(neighbour, -1);
                    continue;
                }
                ASSERT_GE(neighbour, 0);
                ASSERT_NE(neighbour, static_cast<int>(s));
                // If several dots are at the same distance, any of them may be chosen, so the test
                // compares distances.
                ASSERT_EQ(squared_distance(dots[seeds[s]],
                                           dots[seeds[static_cast<std::size_t>(neighbour)]]),
                          expected[n]);
                ASSERT_TRUE(different.insert(neighbour).second);
            }
        }
    }
}

TEST(Neighbours, EdgesAreThosePairsThatBothEndsCount) {
    Rng rng(kSeed);
    for (int set = 0; set < 200; ++set) {
        SCOPED_TRACE(testing::Message() << "set " << set << ", seed " << kSeed);
        const auto dots = points(rng, 1 + static_cast<int>(rng.below(kMaxSeeds)), set % kKinds);
        const auto seeds = all_of(dots);
        Table neighbours(seeds.size());
        std::vector<BucketedSeed> memory(seeds.size() + 1);
        find_neighbours(dots, seeds, memory, neighbours);
        std::set<std::pair<int, int>> expected;
        for (std::size_t a = 0; a < seeds.size(); ++a) {
            for (std::size_t b = 0; b < seeds.size(); ++b) {
                const auto& of_a = neighbours[a];
                const auto& of_b = neighbours[b];
                const bool a_counts_b =
                    std::count(of_a.begin(), of_a.end(), static_cast<int>(b)) > 0;
                const bool b_counts_a =
                    std::count(of_b.begin(), of_b.end(), static_cast<int>(a)) > 0;
                if (a < b && a_counts_b && b_counts_a)
                    expected.insert({static_cast<int>(a), static_cast<int>(b)});
                ASSERT_EQ(are_connected(neighbours, static_cast<int>(a), static_cast<int>(b)),
                          a_counts_b && b_counts_a);
            }
        }
        std::array<SeedEdge, 2 * kMaxSeeds> edges;
        const int count = connect_symmetric(dots, seeds, neighbours, edges);
        std::set<std::pair<int, int>> found;
        for (int e = 0; e < count; ++e) {
            const SeedEdge& edge = edges[static_cast<std::size_t>(e)];
            found.insert({std::min(edge.from, edge.to), std::max(edge.from, edge.to)});
            const FixedVec from = dots[static_cast<std::size_t>(edge.from)].centre_q8;
            const FixedVec to = dots[static_cast<std::size_t>(edge.to)].centre_q8;
            ASSERT_EQ(edge.step_q8, (FixedVec{to.x - from.x, to.y - from.y}));
            // All edges point down, and horizontal edges point to the right (paper, figure 4).
            ASSERT_TRUE(edge.step_q8.y > 0 || (edge.step_q8.y == 0 && edge.step_q8.x >= 0));
        }
        ASSERT_EQ(static_cast<int>(found.size()), count);  // each edge is found once
        ASSERT_EQ(found, expected);
    }
}

TEST(Neighbours, SeedsAreTheDotsNearestTheCentre) {
    Rng rng(kSeed);
    for (const int count : {1, 40, 255, 256, 257, 400, 3000, 16000}) {
        SCOPED_TRACE(testing::Message() << count << " dots, seed " << kSeed);
        const double side = 11 * std::sqrt(count);
        std::vector<DetectedDot> dots;
        for (int i = 0; i < count; ++i)
            dots.push_back(dot_at({rng.uniform(0, side), rng.uniform(0, side)}));
        const Vec2 centre{0.4 * side, 0.6 * side};
        std::array<std::uint16_t, kMaxSeeds> seeds;
        const int chosen = choose_seeds(dots, fixed(centre, 8), seeds);
        if (count <= kMaxSeeds) {
            EXPECT_EQ(chosen, count);
        }
        EXPECT_LE(chosen, kMaxSeeds);
        EXPECT_GE(chosen, std::min(count, 2 * kMaxSeeds / 3));
        const std::set<std::uint16_t> is_seed(seeds.begin(), seeds.begin() + chosen);
        ASSERT_EQ(static_cast<int>(is_seed.size()), chosen);
        double farthest_in = 0;
        double nearest_out = 1e9;
        for (std::uint16_t i = 0; i < count; ++i) {
            const Vec2 d = real(dots[i].centre_q8, 8) - centre;
            const double away = std::max(std::abs(d.x), std::abs(d.y));
            if (is_seed.count(i) > 0) {
                farthest_in = std::max(farthest_in, away);
            } else {
                nearest_out = std::min(nearest_out, away);
            }
        }
        EXPECT_LE(farthest_in, nearest_out + 0.01);
    }
}

TEST(Neighbours, AMixedUpCrowdAtTheCentreStillGivesSeeds) {
    // 500 dots are at the same distance from the centre. This is more than the maximum number of
    // seeds, so only some of these dots are chosen.
    std::vector<DetectedDot> dots(500, dot_at({50, 50}));
    dots.push_back(dot_at({4000, 4000}));
    std::array<std::uint16_t, kMaxSeeds> seeds;
    EXPECT_EQ(choose_seeds(dots, {50 * 256, 50 * 256}, seeds), kMaxSeeds);
}

}  // namespace
}  // namespace dotpose::core_test::neighbours_test

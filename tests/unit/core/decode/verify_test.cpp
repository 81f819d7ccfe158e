// The bound of the probability that chance agrees, and what it leads to.
#include "core/decode/verify.hpp"

#include <gtest/gtest.h>

#include "../reading.hpp"

namespace dotpose::core_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 32;

/// log2((L * 63 * 4) * P(Binomial(n, 1/2) <= e)) for e = 0 to n, the sum of the binomial
/// coefficients scaled by a power of two.
std::vector<long double> exact_chance_log2(int n) {
    const long double hypotheses = std::log2(410815348.0L * 63 * 4);
    std::vector<long double> result;
    long double log_coefficient = 0;  // log2 C(n, k)
    long double log_sum = 0;
    for (int k = 0; k <= n; ++k) {
        if (k > 0) {
            log_coefficient += std::log2(static_cast<long double>(n - k + 1)) -
                               std::log2(static_cast<long double>(k));
            const long double larger = std::max(log_sum, log_coefficient);
            log_sum = larger +
                      std::log2(std::exp2(log_sum - larger) + std::exp2(log_coefficient - larger));
        }
        result.push_back(hypotheses + log_sum - n);
    }
    return result;
}

TEST(Verify, ChanceIsBoundedFromAboveAndNotFarOff) {
    std::vector<int> sizes;
    for (int n = 1; n <= 300; ++n)
        sizes.push_back(n);
    sizes.insert(sizes.end(), {384, 1000, 4096, 16384, 36864});
    for (const int n : sizes) {
        const auto exact = exact_chance_log2(n);
        for (int e = 0; e <= n; ++e) {
            const int bound = chance_log2({n, e});
            ASSERT_GE(bound, exact[static_cast<std::size_t>(e)] - 1e-9L)
                << n << " bits, " << e << " errors";
            if (2 * e > n) continue;
            // The entropy bound gives a factor of up to sqrt(8 n p q) away, the rounding 2 and n /
            // 2^14.
            const double slack = 0.5 * std::log2(8.0 * n) + 3 + n / 8192.0;
            ASSERT_LE(bound, exact[static_cast<std::size_t>(e)] + slack)
                << n << " bits, " << e << " errors";
        }
    }
    EXPECT_GE(chance_log2({0, 0}), 36);
}

struct Verdict {
    Status status;
    Fix fix;
};

Verdict judge(const Reading& reading, const IntegrityOptions& options = {}) {
    const Decoding truth = reading.truth();
    const Nominal nominal(reading.grid(), reading.view.profile, truth);
    std::array<LineScores, kMaxLines> storage;
    Verdict verdict;
    verdict.status =
        verify(reading.grid(), reading.view.profile, truth, nominal, options, storage, verdict.fix);
    return verdict;
}

TEST(Verify, CountsEveryBitThatContradicts) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        Reading reading(random_view(rng), Turn{i % 4});
        Verdict before = judge(reading);
        ASSERT_EQ(before.status, Status::ok);
        ASSERT_EQ(before.fix.bit_errors, 0);
        const auto bits = static_cast<int>(reading.dots.size());
        EXPECT_GE(before.fix.p_wrong_log2, static_cast<double>(exact_chance_log2(bits)[0]));
        // Flip x bits of the grid, one after the other.
        int flipped = 0;
        for (GridCell& cell : reading.owned.cells) {
            if (cell.dot == GridCell::kNoDot || flipped == bits / 4) continue;
            cell.x = static_cast<std::int8_t>(-cell.x);
            ++flipped;
            const Verdict now = judge(reading);
            ASSERT_EQ(now.fix.bit_errors, flipped);
            // More contradictions never make it more certain, but for the closer look that doubt
            // brings: it starts at 1e-12.
            ASSERT_GE(now.fix.p_wrong_log2, std::min(before.fix.p_wrong_log2, -39) - 8);
            const long double chance = exact_chance_log2(bits)[static_cast<std::size_t>(flipped)];
            ASSERT_GE(now.fix.p_wrong_log2, std::min(chance, 0.0L));
            before = now;
        }
        // A quarter of the bits of an axis is what a second pattern in view gives.
        EXPECT_EQ(before.status, Status::not_certain);
    }
}

TEST(Verify, RefusesWhatMissesTheAskedCertainty) {
    Rng rng(kSeed);
    const Reading reading(random_view(rng), {});
    const Verdict usual = judge(reading);
    ASSERT_EQ(usual.status, Status::ok);
    IntegrityOptions options;
    options.max_p_wrong_log2 = usual.fix.p_wrong_log2;
    EXPECT_EQ(judge(reading, options).status, Status::ok);
    options.max_p_wrong_log2 = usual.fix.p_wrong_log2 - 1;
    EXPECT_EQ(judge(reading, options).status, Status::not_certain);
}

TEST(Verify, AWrongPlaceIsNotCertain) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        const Reading reading(random_view(rng), Turn{i % 4});
        Decoding wrong = reading.truth();
        switch (i % 5) {
            case 0:
                wrong.place = random_place(rng);
                break;
            case 1:
                wrong.place = moved(Profile::anoto, wrong.place, 1, 0);
                break;
            case 2:
                wrong.place = moved(Profile::anoto, wrong.place, 0, -1);
                break;
            case 3:
                wrong.place.section.u = static_cast<std::uint8_t>((wrong.place.section.u + 1) % 63);
                break;
            default:
                wrong.place.cell.y = (wrong.place.cell.y + 236 * 233 * 31) % kPositionsPerAxis;
        }
        const Nominal nominal(reading.grid(), Profile::anoto, wrong);
        std::array<LineScores, kMaxLines> storage;
        Fix fix;
        EXPECT_EQ(verify(reading.grid(), Profile::anoto, wrong, nominal, {}, storage, fix),
                  Status::not_certain)
            << "view " << i << ", seed " << kSeed;
    }
}

}  // namespace
}  // namespace dotpose::core_test

// The bound of the probability that chance agrees, and what it leads to.
#include "core/decode/verify.hpp"

#include <gtest/gtest.h>

#include "../reading.hpp"
#include "chance.hpp"

namespace dotpose::core_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 32;

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

// Tests the upper bound on the probability of a match by chance, and the resulting verdicts.
#include "core/integrity/verify.hpp"

#include <gtest/gtest.h>

#include "../reading.hpp"
#include "chance.hpp"
#include "core/decode/position.hpp"
#include "core/integrity/confidence.hpp"
#include "core/kernels/select.hpp"
#include "single_odds.hpp"

namespace dotpose::core_test::verify_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 32;

struct Verdict {
    Status status;
    Fix fix;
};

using Storage = std::array<ScoredLine, 2 * kMaxLines>;

Status verify_one_code(const core::Grid& grid, CodeVariant code, Decoding& decoding,
                       const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix) {
    WorkLimit plenty(100'000'000);
    return verify(kernels(), grid, code, nullptr, options, storage, plenty, decoding, fix);
}

/// Variant of `verify_one_code` that must not count alternatives one by one.
Status verify_without_work(const core::Grid& grid, CodeVariant code, Decoding& decoding,
                           const IntegrityOptions& options, std::span<ScoredLine> storage,
                           Fix& fix) {
    WorkLimit none(0);
    return verify(kernels(), grid, code, nullptr, options, storage, none, decoding, fix);
}

Verdict judge(const Reading& reading, const IntegrityOptions& options = {},
              decltype(verify_one_code) how = verify_one_code) {
    Storage storage;
    Verdict verdict;
    Decoding decoding = reading.truth();
    verdict.status =
        how(reading.grid(), reading.view.code, decoding, options, storage, verdict.fix);
    return verdict;
}

TEST(Verify, CountsEveryBitThatContradicts) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        Reading reading(random_view(rng), QuarterTurn{i % 4});
        Verdict before = judge(reading);
        ASSERT_EQ(before.status, Status::ok);
        ASSERT_EQ(before.fix.bit_errors, 0);
        const auto bits = static_cast<int>(reading.dots.size());
        EXPECT_GE(before.fix.p_wrong_log2, static_cast<double>(exact_chance_log2(bits)[0]));
        IntegrityOptions any;
        any.max_p_wrong_log2 = 0;
        Verdict quick_before = judge(reading, any, verify_quickly);
        int flipped = 0;
        for (GridCell& cell : reading.owned.cells) {
            if (cell.dot == GridCell::kNoDot || flipped == bits / 4) continue;
            cell.x = static_cast<std::int8_t>(-cell.x);
            ++flipped;
            const Verdict now = judge(reading);
            ASSERT_EQ(now.fix.bit_errors, flipped);
            // Additional wrong bits must not reduce the quick estimate of p_wrong.
            const Verdict quick = judge(reading, any, verify_quickly);
            ASSERT_EQ(quick.fix.bit_errors, flipped);
            // If the odds on an axis are below 2^-36, `quick_alternatives` does not compute them
            // exactly, so estimates below 2^-34 are treated as equal. Rounding may change each
            // `p_wrong_log2` by 1.
            constexpr int kCoarse = -34;
            ASSERT_GE(std::max(quick.fix.p_wrong_log2, kCoarse),
                      std::max(quick_before.fix.p_wrong_log2, kCoarse) - 1);
            quick_before = quick;
            const long double chance = exact_chance_log2(bits)[static_cast<std::size_t>(flipped)];
            ASSERT_GE(now.fix.p_wrong_log2, std::min(chance, 0.0L));
            before = now;
        }
        EXPECT_EQ(before.status, Status::not_certain);
    }
}

TEST(Verify, RefusesWhatMissesTheAskedCertainty) {
    Rng rng(kSeed);
    const Reading reading(random_view(rng), {});
    const Verdict usual = judge(reading);
    ASSERT_EQ(usual.status, Status::ok);
    for (const auto how : {verify_one_code, verify_quickly}) {
        IntegrityOptions options;
        options.max_p_wrong_log2 = usual.fix.p_wrong_log2;
        Verdict verdict = judge(reading, options, how);
        EXPECT_EQ(verdict.status, Status::ok);
        EXPECT_EQ(verdict.fix.p_wrong_log2, usual.fix.p_wrong_log2);
        // Repeatedly sets the limit just below the last result. Counting the alternatives one by
        // one may still confirm the position.
        int looks = 0;
        for (; verdict.status == Status::ok; ++looks) {
            ASSERT_LE(verdict.fix.p_wrong_log2, options.max_p_wrong_log2);
            options.max_p_wrong_log2 = verdict.fix.p_wrong_log2 - 1;
            verdict = judge(reading, options, how);
        }
        EXPECT_EQ(verdict.status, Status::not_certain);
        if (how == verify_one_code) {
            EXPECT_GE(looks, 2);
        } else {
            EXPECT_EQ(looks, 1);
        }
    }
}

TEST(Verify, AWrongPlaceIsNotCertain) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        const Reading reading(random_view(rng), QuarterTurn{i % 4});
        Decoding wrong = reading.truth();
        switch (i % 5) {
            case 0:
                wrong.place = random_place(rng);
                break;
            case 1:
                wrong.place = moved(CodeVariant::anoto, wrong.place, 1, 0);
                break;
            case 2:
                wrong.place = moved(CodeVariant::anoto, wrong.place, 0, -1);
                break;
            case 3:
                wrong.place.section.u = static_cast<std::uint8_t>((wrong.place.section.u + 1) % 63);
                break;
            default:
                wrong.place.cell.y = (wrong.place.cell.y + 236 * 233 * 31) % kPositionsPerAxis;
        }
        Storage storage;
        Fix fix;
        EXPECT_EQ(verify_one_code(reading.grid(), CodeVariant::anoto, wrong, {}, storage, fix),
                  Status::not_certain)
            << "view " << i << ", seed " << kSeed;
        EXPECT_EQ(verify_quickly(reading.grid(), CodeVariant::anoto, wrong, {}, storage, fix),
                  Status::not_certain)
            << "view " << i << ", seed " << kSeed;
    }
}

TEST(Verify, LinesThatAreScoredAreNotScoredAgain) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const Reading reading(random_view(rng), QuarterTurn{i % 4});
        Storage storage;
        Decoding found = reading.decoding;
        ASSERT_EQ(decode_all(reading.grid(), CodeVariant::anoto, storage, found), Status::ok);
        ASSERT_TRUE(found.lines_are_scored);
        const Verdict fresh = judge(reading);
        Fix fix;
        EXPECT_EQ(verify_one_code(reading.grid(), CodeVariant::anoto, found, {}, storage, fix),
                  Status::ok);
        EXPECT_EQ(fix.p_wrong_log2, fresh.fix.p_wrong_log2);
        // Clears the stored scores. All rolls then have equal scores, so no alternative is
        // excluded. `verify` must use the stored scores, and must therefore refuse the position.
        storage.fill({});
        EXPECT_EQ(verify_one_code(reading.grid(), CodeVariant::anoto, found, {}, storage, fix),
                  Status::not_certain);
    }
}

TEST(Verify, RefusesTwoPatternsWhateverTheLimit) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        Reading reading(random_view(rng), QuarterTurn{i % 4});
        // Flips about half of the bits at random, as if the frame showed another pattern.
        for (GridCell& cell : reading.owned.cells) {
            if (rng.below(2) == 0) cell.x = static_cast<std::int8_t>(-cell.x);
            if (rng.below(2) == 0) cell.y = static_cast<std::int8_t>(-cell.y);
        }
        IntegrityOptions any;
        any.max_p_wrong_log2 = 0;
        for (const auto how : {verify_one_code, verify_quickly}) {
            const Verdict verdict = judge(reading, any, how);
            EXPECT_EQ(verdict.status, Status::not_certain);
            EXPECT_EQ(verdict.fix.p_wrong_log2, 0);
        }
    }
}

/// Returns a difficult view: it is small, and some of its dots are missing, are displaced, or have
/// a wrong symbol.
Reading troubled(Rng& rng, int turn) {
    View view = random_view(rng);
    view.code = kCodeVariants[static_cast<std::size_t>(rng.below(3))];
    view.image_px = {rng.uniform(100, 200), rng.uniform(100, 130)};
    const double wrong = rng.uniform(0, 0.08);
    const double missing = rng.uniform(0, 0.15);
    const double scatter_px = rng.uniform(0, 0.7);
    const Mesh mesh = view.mesh();
    std::vector<DetectedDot> dots;
    for (const PlacedDot& d : pattern_dots(view)) {
        if (rng.uniform() < missing) continue;
        const Vec2 other = random_displacement(rng);
        const Vec2 place =
            rng.uniform() < wrong ? mesh.at(d.cell.x + other.x, d.cell.y + other.y) : d.centre_px;
        dots.push_back(dot_at(place + scatter_px * Vec2{rng.normal(), rng.normal()}));
    }
    return Reading(view, QuarterTurn{turn}, dots);
}

/// Returns a lower bound on what `verify` must report for a reading, as log2: the sum over both
/// axes of the bound on the probability of a match by chance and the odds of the single
/// alternatives.
double least_p_wrong(const Reading& reading) {
    const Decoding truth = reading.truth();
    const CodeVariant code = reading.view.code;
    const Grid& grid = reading.grid();
    const auto place_of = [&](FixedVec cell) {
        const FixedVec step = truth.pattern_from_grid(cell);
        return moved(code, truth.place, step.x, step.y);
    };
    std::array<Confidence, 2> axes;
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            const Place at = place_of({i, j});
            const Symbol symbol = symbol_at(code, at.cell, at.section);
            const Bits bits = turned(truth.pattern_from_grid, grid.at(i, j));
            if (bits.x != 0) axes[0].add(bits.x, (bits.x > 0) != (x_bit(symbol) == 1));
            if (bits.y != 0) axes[1].add(bits.y, (bits.y > 0) != (y_bit(symbol) == 1));
        }
    }
    Confidence both = axes[0];
    both.add(axes[1]);
    const int odds = odds_per_bit_q8(both);

    const Upright upright(grid, truth.region, truth.pattern_from_grid);
    const Place corner = place_of(upright.corner());
    Storage storage;
    double sum = 0;
    for (const Axis axis : {Axis::x, Axis::y}) {
        const bool is_x = axis == Axis::x;
        const std::uint32_t own = is_x ? corner.cell.x : corner.cell.y;
        const std::uint32_t cross = is_x ? corner.cell.y : corner.cell.x;
        const int section = is_x ? corner.section.u : corner.section.v;
        AxisReading read;
        read.position = own;
        read.roll = static_cast<std::uint8_t>(
            (roll(code, own) + section + static_cast<int>(cross % kSections)) % kSections);
        sum += std::exp2(chance_log2(axes[is_x ? 0 : 1], odds)) +
               single_odds(LikelihoodRatios(code, score_lines(upright, axis, storage), read, odds));
    }
    return std::log2(sum);
}

TEST(VerifyQuickly, NeverClaimsMoreThanACloseLookBears) {
    Rng rng(kSeed);
    IntegrityOptions options;
    options.max_p_wrong_log2 = -8;
    int accepted = 0;
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const Reading reading = troubled(rng, i % 4);
        if (reading.status != Status::ok) continue;
        const Verdict quick = judge(reading, options, verify_quickly);
        if (quick.status != Status::ok) continue;
        ++accepted;
        EXPECT_GE(quick.fix.p_wrong_log2, least_p_wrong(reading));
        const Verdict close = judge(reading, options);
        EXPECT_EQ(close.status, Status::ok);
        EXPECT_LE(close.fix.p_wrong_log2, quick.fix.p_wrong_log2);
        EXPECT_EQ(close.fix.bit_errors, quick.fix.bit_errors);
    }
    EXPECT_GE(accepted, 100) << "seed " << kSeed;
}

TEST(VerifyQuickly, AcceptsWhatIsClearlyRead) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        View view = random_view(rng);
        view.code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        const Verdict verdict = judge(Reading(view, QuarterTurn{i % 4}), {}, verify_quickly);
        EXPECT_EQ(verdict.status, Status::ok);
        EXPECT_EQ(verdict.fix.bit_errors, 0);
        EXPECT_LE(verdict.fix.p_wrong_log2, -30);
    }
}

TEST(Verify, ACloserLookCertifiesWhatAQuickOneCannot) {
    Rng rng(kSeed);
    int more = 0;
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        const Reading reading = troubled(rng, i % 4);
        if (reading.status != Status::ok) continue;
        const Verdict quick = judge(reading, {}, verify_quickly);
        const Verdict close = judge(reading);
        EXPECT_LE(close.fix.p_wrong_log2, quick.fix.p_wrong_log2);
        more += quick.status != Status::ok && close.status == Status::ok;
        if (close.status != Status::ok) continue;
        EXPECT_GE(close.fix.p_wrong_log2, least_p_wrong(reading) - 0.1);
        const Verdict hasty = judge(reading, {}, verify_without_work);
        EXPECT_EQ(hasty.status, quick.status);
    }
    EXPECT_GT(more, 0) << "seed " << kSeed;
}

}  // namespace
}  // namespace dotpose::core_test::verify_test

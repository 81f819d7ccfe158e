// Tests the search that uses the steps between all neighbouring lines. This search is necessary if
// no run of lines determines the position.
#include "core/decode/step_search.hpp"

#include <gtest/gtest.h>

#include "../integrity/ratios_case.hpp"

namespace dotpose::core_test::step_search_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 71;

/// Appends lines of `bits` bits each. Each bit is flipped with probability `wrong`. Lines for which
/// `is_hidden` is true have no bits.
template <typename IsHidden>
void read_lines(RatiosCase& c, int bits, double wrong, Rng& rng, IsHidden is_hidden) {
    for (std::size_t i = 0; i < c.rolls.size(); ++i) {
        c.storage.push_back(is_hidden(i) ? ScoredLine{}
                                         : scored_line(c.rolls[i], bits, wrong, 127, rng));
    }
}

AxisReading found(const RatiosCase& c) {
    AxisReading reading{0, 0, INT32_MIN, 0};
    search_by_steps(c.code, c.lines(), reading);
    return reading;
}

bool is_true(const AxisReading& reading, const RatiosCase& c) {
    return reading.position == c.position && reading.roll == c.rolls[0];
}

TEST(SearchBySteps, ReadsLinesOnBothSidesOfHiddenOnes) {
    Rng rng(kSeed);
    int right = 0;
    for (int i = 0; i < 300; ++i) {
        // On each side of the hidden lines, only five consecutive lines have bits. The window
        // decoder needs six.
        const std::size_t hidden = 1 + rng.below(3);
        RatiosCase c = at_random_place(rng, 10 + static_cast<int>(hidden));
        read_lines(c, 12, 0.03, rng,
                   [&](std::size_t line) { return line >= 5 && line < 5 + hidden; });
        right += is_true(found(c), c) ? 1 : 0;
    }
    EXPECT_GE(right, 295) << "seed " << kSeed;
}

TEST(SearchBySteps, ReadsLinesWithWrongBits) {
    Rng rng(kSeed + 1);
    int right = 0;
    for (int i = 0; i < 200; ++i) {
        RatiosCase c = at_random_place(rng, 30);
        read_lines(c, 12, 0.1, rng, [](std::size_t) { return false; });
        right += is_true(found(c), c) ? 1 : 0;
    }
    EXPECT_GE(right, 195) << "seed " << kSeed + 1;
}

TEST(SearchBySteps, ReadsOnOverTheEndOfTheCode) {
    Rng rng(kSeed + 2);
    RatiosCase c = at_random_place(rng, 12);
    c.code = CodeVariant::anoto;
    c.position = kPositionsPerAxis - 5;
    for (std::size_t i = 1; i < c.rolls.size(); ++i) {
        const std::uint64_t before = (std::uint64_t{c.position} + i - 1) % kPositionsPerAxis;
        c.rolls[i] = (c.rolls[i - 1] + code_test::reference_delta(c.code, before)) % 63;
    }
    read_lines(c, 12, 0, rng, [](std::size_t) { return false; });
    EXPECT_TRUE(is_true(found(c), c));
}

TEST(SearchBySteps, KeepsWhatIsAsGood) {
    Rng rng(kSeed + 3);
    RatiosCase c = at_random_place(rng, 10);
    read_lines(c, 12, 0, rng, [](std::size_t) { return false; });
    const std::int32_t most = found(c).score;
    AxisReading better{7, 8, most, most};
    search_by_steps(c.code, c.lines(), better);
    EXPECT_EQ(better.position, 7u);
    EXPECT_EQ(better.roll, 8);
    AxisReading worse{7, 8, most - 1, most};
    search_by_steps(c.code, c.lines(), worse);
    EXPECT_TRUE(is_true(worse, c));
    EXPECT_EQ(worse.max_possible, most);
}

}  // namespace
}  // namespace dotpose::core_test::step_search_test

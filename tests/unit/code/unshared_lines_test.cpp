// Tests the tables of unshared lines, which contain the minimum number of lines that two places in
// a sequence do not share. Two places share a line at shift s if their rolls in this line differ by
// s. The tests compute the expected numbers by comparing the places line by line.
#include "code/unshared_lines.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "code/basis.hpp"
#include "reference.hpp"

namespace dotpose::code {
namespace {

constexpr std::size_t kMaxLines = 16;
using Lines = std::array<std::size_t, kMaxLines + 1>;
using Unshared = std::pair<std::size_t, std::size_t>;

/// Returns an array whose element n is the maximum number of equal offsets among the first n lines,
/// or among the last n lines if `from_last` is true.
Lines max_equal(const std::array<int, kMaxLines>& offsets, std::size_t lines, bool from_last) {
    std::array<std::size_t, kSections> counts{};
    Lines most{};
    for (std::size_t n = 0; n < lines; ++n) {
        const int offset = offsets[from_last ? lines - 1 - n : n];
        most[n + 1] = std::max(most[n], ++counts[static_cast<std::size_t>(offset)]);
    }
    return most;
}

/// Returns the minimum number of unshared lines between `place` and any other place in the
/// sequence, for two cases. In the first case, all lines have the same shift. In the second case,
/// the shift may change once, at a border between two lines.
Unshared counted(const Secondary& a, std::uint32_t place, std::size_t lines) {
    std::size_t max_at_one = 0;
    std::size_t max_on_both = 0;
    for (std::uint32_t other = 0; other < a.length; ++other) {
        if (other == place) continue;
        std::array<int, kMaxLines> offsets{};
        for (std::size_t line = 0; line < lines; ++line)
            offsets[line] = (a.rolls[other + line] - a.rolls[place + line] + kSections) % kSections;
        const Lines before = max_equal(offsets, lines, false);
        const Lines from = max_equal(offsets, lines, true);
        max_at_one = std::max(max_at_one, before[lines]);
        for (std::size_t border = 0; border <= lines; ++border)
            max_on_both = std::max(max_on_both, before[border] + from[lines - border]);
    }
    return {lines - max_at_one, lines - max_on_both};
}

TEST(UnsharedLines, AreAsCounted) {
    const Basis& sequences = basis(CodeVariant::anoto);
    for (std::size_t row = 0; row < kUnsharedOf.size(); ++row) {
        for (std::size_t k = 0; k < sequences.size(); ++k) {
            for (std::uint32_t place = 0; place < sequences[k].length; ++place) {
                const std::size_t entry = kUnsharedFrom[k] + place;
                ASSERT_EQ(
                    Unshared(unshared_at_one_shift(entry, row), unshared_on_two_sides(entry, row)),
                    counted(sequences[k], place, static_cast<std::size_t>(kUnsharedOf[row])))
                    << row << ' ' << k << ' ' << place;
            }
        }
    }
}

using Counts = std::array<int, kMaxCounted>;

/// Counts the pairs (other place, shift) that share at least one line with `place`. Element n - 1
/// of the result is the number of pairs with exactly n unshared lines.
Counts counted_by_unshared(const Secondary& a, std::uint32_t place, std::size_t lines) {
    Counts counts{};
    for (std::uint32_t other = 0; other < a.length; ++other) {
        if (other == place) continue;
        std::array<std::size_t, kSections> shared{};
        for (std::size_t line = 0; line < lines; ++line)
            ++shared[static_cast<std::size_t>(
                (a.rolls[other + line] - a.rolls[place + line] + kSections) % kSections)];
        for (const std::size_t n : shared) {
            EXPECT_LT(n, lines);
            if (n > 0 && lines - n <= kMaxCounted) ++counts[lines - n - 1];
        }
    }
    return counts;
}

TEST(UnsharedLines, AreOfAsManyPositionsAsCounted) {
    for (std::size_t row = 0; row < kUnsharedOf.size(); ++row) {
        for (std::size_t k = 0; k < 4; ++k) {
            Counts most{};
            for (const CodeVariant code : code_test::kCodeVariants) {
                const Secondary& a = basis(code)[k];
                for (std::uint32_t place = 0; place < a.length; ++place) {
                    const Counts here =
                        counted_by_unshared(a, place, static_cast<std::size_t>(kUnsharedOf[row]));
                    for (std::size_t n = 0; n < most.size(); ++n)
                        most[n] = std::max(most[n], here[n]);
                }
            }
            for (std::size_t n = 0; n < most.size(); ++n)
                EXPECT_EQ(most[n], kMaxPositionsWith[row][k][n]) << row << ' ' << k << ' ' << n + 1;
        }
    }
}

}  // namespace
}  // namespace dotpose::code

// Tests the table of the minimum number of lines that two places in different code variants do not
// share. Two places share a line at shift s if their rolls in this line differ by s. The expected
// numbers are obtained by counting lines with different rolls in the sequences of the reference
// implementation.
#include "code/unshared_codes.hpp"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "reference.hpp"

namespace dotpose::code_test::unshared_codes_test {
namespace {

/// Returns the contribution of a4 to the roll of each of `lines` lines, starting at `place`. The
/// contribution is the weighted sum of all preceding digits of a4, modulo 63.
std::vector<int> a4_rolls(CodeVariant code, std::size_t place, int lines) {
    const std::string_view a4 = secondary_texts(code)[3];
    std::vector<int> rolls;
    int sum = 0;
    for (std::size_t p = 0; p < place; ++p)
        sum += 18 * (a4[p] - '0');
    for (std::size_t line = 0; line < static_cast<std::size_t>(lines); ++line) {
        rolls.push_back(sum % 63);
        sum += 18 * (a4[(place + line) % a4.size()] - '0');
    }
    return rolls;
}

int max_shared(CodeVariant read, std::size_t own, CodeVariant other, int lines) {
    const std::vector<int> rolls = a4_rolls(read, own, lines);
    const bool have_same_rolls = read != CodeVariant::microdots && other != CodeVariant::microdots;
    int most = 0;
    for (std::size_t place = 0; place < 241; ++place) {
        const std::vector<int> theirs = a4_rolls(other, place, lines);
        std::array<int, 63> shared{};
        for (std::size_t line = 0; line < rolls.size(); ++line) {
            const int shift = (theirs[line] - rolls[line] + 63) % 63;
            if (have_same_rolls && place == own && shift == 0) continue;
            most = std::max(most, ++shared[static_cast<std::size_t>(shift)]);
        }
    }
    return most;
}

TEST(UnsharedInOther, IsWhatCountingGives) {
    for (const CodeVariant read : kCodeVariants) {
        for (const CodeVariant other : kCodeVariants) {
            if (read == other) continue;
            for (std::size_t i = 0; i < code::kUnsharedOf.size(); ++i) {
                const std::string_view row =
                    code::kUnsharedInOther[static_cast<std::size_t>(read)]
                                          [static_cast<std::size_t>(other)][i];
                ASSERT_EQ(row.size(), 241U);
                const int lines = code::kUnsharedOf[i];
                for (std::size_t place = 0; place < 241; place += 7)
                    ASSERT_EQ(row[place] - '0', lines - max_shared(read, place, other, lines));
            }
        }
    }
}

TEST(UnsharedInOther, TheSamePlaceHasTheSameRollsInAnotoAndLibdots) {
    for (std::uint32_t position = 0; position < kPositionsPerAxis; position += 1'234'567) {
        if (position % 241 < 222) {
            EXPECT_EQ(roll(CodeVariant::anoto, position), roll(CodeVariant::libdots, position));
        }
    }
}

}  // namespace
}  // namespace dotpose::code_test::unshared_codes_test

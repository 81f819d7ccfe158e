// Enumerates the sequences, to test the properties on which dotpose relies. docs/position-code.md
// lists these properties.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dotpose/code.hpp"
#include "gtest/gtest.h"
#include "reference.hpp"

namespace dotpose::code_test::sequences_test {
namespace {

/// Returns all strings of the given length in a cyclic sequence, indexed by the position of their
/// first digit.
std::vector<std::string> strings_of(const std::string& cycle, std::size_t length) {
    std::vector<std::string> result;
    for (std::size_t start = 0; start < cycle.size(); ++start) {
        std::string s;
        for (std::size_t i = 0; i < length; ++i)
            s += cycle[(start + i) % cycle.size()];
        result.push_back(s);
    }
    return result;
}

std::vector<std::string> main_strings(std::size_t length) {
    std::string cycle;
    for (std::uint32_t i = 0; i < 63; ++i)
        cycle += static_cast<char>('0' + main_bit(i));
    return strings_of(cycle, length);
}

/// Returns the sequence a4. Its digits are the most significant digits of the differences d = 5 +
/// a1 + 3 a2 + 9 a3 + 18 a4.
std::string a4_of(CodeVariant code) {
    std::string cycle;
    for (std::uint32_t p = 0; p < 241; ++p) {
        cycle += static_cast<char>('0' + (delta(code, p) - 5) / 18);
    }
    return cycle;
}

std::string flipped(std::string s) {
    for (char& c : s)
        c = c == '0' ? '1' : '0';
    return s;
}

std::string reversed(std::string s) {
    std::reverse(s.begin(), s.end());
    return s;
}

int distance(const std::string& a, const std::string& b) {
    int differing = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        differing += a[i] != b[i] ? 1 : 0;
    return differing;
}

template <typename Change>
int count_also_occurring(std::size_t length, Change change) {
    const auto all = main_strings(length);
    return static_cast<int>(std::count_if(all.begin(), all.end(), [&](const std::string& s) {
        return std::find(all.begin(), all.end(), change(s)) != all.end();
    }));
}

int smallest_distance(std::size_t length) {
    const auto all = main_strings(length);
    int smallest = static_cast<int>(length);
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            smallest = std::min(smallest, distance(all[i], all[j]));
    }
    return smallest;
}

int smallest_distance_to_turned(std::size_t length) {
    const auto all = main_strings(length);
    int smallest = static_cast<int>(length);
    for (const std::string& a : all) {
        for (const std::string& b : all) {
            smallest = std::min(smallest, distance(a, flipped(reversed(b))));
        }
    }
    return smallest;
}

/// Returns the places of every string that occurs more than once in the cycle, indexed by string.
std::map<std::string, std::vector<int>> doubled(const std::string& cycle, std::size_t length) {
    std::map<std::string, std::vector<int>> places;
    const auto all = strings_of(cycle, length);
    for (std::size_t i = 0; i < all.size(); ++i)
        places[all[i]].push_back(static_cast<int>(i));
    std::erase_if(places, [](const auto& entry) { return entry.second.size() == 1; });
    return places;
}

/// Returns the ternary strings of length 5 that do not occur in a cycle.
std::set<std::string> absent(const std::string& cycle) {
    std::set<std::string> result;
    for (int key = 0; key < 243; ++key) {
        std::string s;
        for (int i = 0, rest = key; i < 5; ++i, rest /= 3) {
            s += static_cast<char>('0' + rest % 3);
        }
        result.insert(s);
    }
    for (const std::string& s : strings_of(cycle, 5))
        result.erase(s);
    return result;
}

TEST(MainSequence, LeavesOutOnlySixOnes) {
    const auto all = main_strings(6);
    EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 63U);
    EXPECT_EQ(std::count(all.begin(), all.end(), "111111"), 0);
}

TEST(MainSequence, SevenBitsTellThatItIsUpsideDown) {
    const auto turn = [](const std::string& s) { return flipped(reversed(s)); };
    EXPECT_EQ(count_also_occurring(6, turn), 62);
    for (std::size_t n = 7; n <= 63; ++n)
        EXPECT_EQ(count_also_occurring(n, turn), 0) << n;
}

TEST(MainSequence, FlippingOrReversingAloneIsNotAlwaysSeenInEight) {
    EXPECT_EQ(count_also_occurring(8, reversed), 15);
    EXPECT_EQ(count_also_occurring(8, flipped), 16);
    EXPECT_EQ(count_also_occurring(12, reversed), 0);
    EXPECT_EQ(count_also_occurring(11, flipped), 0);
}

TEST(MainSequence, LongerStringsDifferInMorePlaces) {
    EXPECT_EQ(smallest_distance(7), 1);
    EXPECT_EQ(smallest_distance(8), 2);
    EXPECT_EQ(smallest_distance(13), 2);
    EXPECT_EQ(smallest_distance(14), 3);
    EXPECT_EQ(smallest_distance(15), 3);
    EXPECT_EQ(smallest_distance(16), 4);
    EXPECT_EQ(smallest_distance(17), 4);
    EXPECT_EQ(smallest_distance_to_turned(8), 1);
    EXPECT_EQ(smallest_distance_to_turned(14), 2);
    EXPECT_EQ(smallest_distance_to_turned(17), 2);
}

// For each bit of each 8-bit string of the main sequence, flips the bit and then chooses the
// nearest 8-bit string of the sequence, with ties broken at random. According to the paper (section
// II-B.7), 36 % of these choices are correct. Enumeration gives 8/21, which is 38 %.
TEST(MainSequence, TheNearestStringIsTheRightOneIn38Percent) {
    const auto all = main_strings(8);
    double right = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t bit = 0; bit < 8; ++bit) {
            std::string seen = all[i];
            seen[bit] = seen[bit] == '0' ? '1' : '0';
            std::vector<int> distances;
            distances.reserve(all.size());
            for (const std::string& s : all)
                distances.push_back(distance(seen, s));
            const int smallest = *std::min_element(distances.begin(), distances.end());
            const auto ties = std::count(distances.begin(), distances.end(), smallest);
            if (distances[i] == smallest) right += 1.0 / static_cast<double>(ties);
        }
    }
    EXPECT_NEAR(right / (63 * 8), 8.0 / 21.0, 1e-9);
}

TEST(A4, ThePublishedOneIsMisprinted) {
    const std::string a4 = a4_of(CodeVariant::libdots);
    std::set<std::vector<int>> places;
    for (const auto& [s, where] : doubled(a4, 5))
        places.insert(where);
    EXPECT_EQ(places, (std::set<std::vector<int>>{
                          {82, 238}, {170, 236}, {177, 237}, {195, 217}, {198, 218}, {199, 219}}));
    ASSERT_EQ(doubled(a4, 6).size(), 1U);
    EXPECT_EQ(doubled(a4, 6).begin()->second, (std::vector<int>{198, 218}));
    EXPECT_TRUE(doubled(a4, 7).empty());
}

TEST(A4, TheRestoredOneLeavesOutTwoConstantStrings) {
    const std::string a4 = a4_of(CodeVariant::anoto);
    EXPECT_TRUE(doubled(a4, 5).empty());
    EXPECT_EQ(absent(a4), (std::set<std::string>{"11111", "22222"}));
}

TEST(A4, TheMicrodotsOneIsSound) {
    const std::string a4 = a4_of(CodeVariant::microdots);
    EXPECT_TRUE(doubled(a4, 5).empty());
    EXPECT_EQ(absent(a4).size(), 2U);
}

// The patent prints only 240 of the 241 digits. Open implementations append a 1 as the last digit.
TEST(A4, OnlyOneInsertedDigitRestoresThePatents) {
    const std::string printed = a4_of(CodeVariant::libdots).substr(0, 240);
    std::set<std::string> sound;
    for (std::size_t i = 0; i <= printed.size(); ++i) {
        for (const char digit : {'0', '1', '2'}) {
            std::string candidate = printed;
            candidate.insert(i, 1, digit);
            if (doubled(candidate, 5).empty()) sound.insert(candidate);
        }
    }
    EXPECT_EQ(sound, std::set<std::string>{a4_of(CodeVariant::anoto)});
    EXPECT_EQ(a4_of(CodeVariant::anoto), std::string(printed).insert(220, 1, '1'));
}

}  // namespace
}  // namespace dotpose::code_test::sequences_test

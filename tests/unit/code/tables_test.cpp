// Tests lookup tables against divisions and against the digits of the sequences.
#include "code/tables.hpp"

#include <gtest/gtest.h>

#include "code/basis.hpp"
#include "reference.hpp"

namespace dotpose::code_test::tables_test {
namespace {

constexpr std::uint32_t kSeed = 61;

/// Returns random 32-bit numbers, and numbers near both ends of the range.
std::vector<std::uint32_t> many_numbers() {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t n = 0; n < 70000; ++n) {
        numbers.push_back(n);
        numbers.push_back(UINT32_MAX - n);
    }
    std::mt19937 rng(kSeed);
    for (int i = 0; i < 200000; ++i)
        numbers.push_back(static_cast<std::uint32_t>(rng()));
    return numbers;
}

TEST(ModuloSections, LeavesWhatADivisionLeaves) {
    for (const std::uint32_t n : many_numbers())
        ASSERT_EQ(code::modulo_sections(n), n % 63) << n;
    for (std::uint32_t n = 0; n < 4095; ++n)
        ASSERT_EQ(code::short_modulo_sections(n), n % 63) << n;
}

TEST(Secondary, HasThePlaceThatADivisionLeaves) {
    for (const code::Secondary& a : code::basis(CodeVariant::anoto)) {
        for (const std::uint32_t n : many_numbers())
            ASSERT_EQ(a.place_of(n), n % a.length) << n << " of " << int{a.length};
    }
}

TEST(Secondary, HasTheDigitsOfTheText) {
    for (const CodeVariant code : kCodeVariants) {
        const auto texts = secondary_texts(code);
        for (std::size_t k = 0; k < texts.size(); ++k) {
            const code::Secondary& a = code::basis(code)[k];
            for (std::uint32_t place = 0; place < a.length; ++place)
                ASSERT_EQ(a.digit(place), digit_at(texts[k], place)) << k << ", " << place;
        }
    }
}

TEST(Secondary, RollsAndPlacesOfDigitsGoOnBeyondTheEnd) {
    for (const CodeVariant code : kCodeVariants) {
        const auto texts = secondary_texts(code);
        for (std::size_t k = 0; k < texts.size(); ++k) {
            const code::Secondary& a = code::basis(code)[k];
            ASSERT_EQ(a.length, texts[k].size());
            int roll = 0;
            for (std::size_t i = 0; i < a.length + code::kLinesAhead; ++i) {
                ASSERT_EQ(a.rolls[i], roll % 63) << k << ", " << i;
                roll += kWeights[k] * digit_at(texts[k], i);
            }
            for (std::size_t i = 0; i < a.length + 32U; ++i) {
                for (int digit = 0; digit < a.base; ++digit) {
                    const bool stands = (a.places_of[digit][i / 32] >> i % 32 & 1) != 0;
                    ASSERT_EQ(stands, digit_at(texts[k], i) == digit) << k << ", " << i;
                }
            }
        }
    }
}

}  // namespace
}  // namespace dotpose::code_test::tables_test

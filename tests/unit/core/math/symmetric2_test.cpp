#include "core/math/symmetric2.hpp"

#include <array>
#include <cstdint>

#include <gtest/gtest.h>

namespace dotpose::core {
namespace {

// The system 3 x + 2 y = 16, 2 x + 5 y = 29 has the solution (2, 5) and the determinant 11.
constexpr Symmetric2<std::int64_t> kIntegers{3, 2, 5};

TEST(Symmetric2, SolvesTimesTheDeterminant) {
    EXPECT_EQ(kIntegers.determinant(), 11);
    EXPECT_EQ(kIntegers.solve_scaled(16, 29), (std::array<std::int64_t, 2>{22, 55}));
}

TEST(Symmetric2, TakesAsManyBitsAsTheIntegersOfTheFits) {
    constexpr std::int64_t kLarge = (std::int64_t{1} << 30) - 1;
    constexpr Symmetric2<std::int64_t> kWide{kLarge, 0, kLarge};
    EXPECT_EQ(kWide.determinant(), 1152921502459363329);
    EXPECT_EQ(kWide.solve_scaled(-kLarge, kLarge),
              (std::array<std::int64_t, 2>{-1152921502459363329, 1152921502459363329}));
}

TEST(Symmetric2, InverseUndoesTheProduct) {
    constexpr Symmetric2<float> kMatrix{4, 1, 0.5F};
    const std::array<float, 2> product = kMatrix * std::array<float, 2>{3, -8};
    EXPECT_EQ(product, (std::array<float, 2>{4, -1}));
    const std::array<float, 2> back = kMatrix.inverse() * product;
    EXPECT_FLOAT_EQ(back[0], 3);
    EXPECT_FLOAT_EQ(back[1], -8);
}

TEST(Symmetric2, OfPointsOnOneLineTheDeterminantIsZero) {
    EXPECT_EQ((Symmetric2<std::int64_t>{4, 6, 9}.determinant()), 0);
}

}  // namespace
}  // namespace dotpose::core

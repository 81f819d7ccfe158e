#include "draw/deviation.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace dotpose::draw {
namespace {

TEST(plus_minus, is_never_zero) {
    EXPECT_EQ(plus_minus(0.0000061, 6), " +- 0.000006");
    EXPECT_EQ(plus_minus(12.345, 2), " +- 12.35");
    EXPECT_EQ(plus_minus(0.0000004, 6), " +- 4e-07");
    EXPECT_EQ(plus_minus(0.004, 2), " +- 0.004");
    EXPECT_EQ(plus_minus(0, 6), "");
    EXPECT_EQ(plus_minus(std::numeric_limits<double>::infinity(), 6), " +- inf");
}

}  // namespace
}  // namespace dotpose::draw

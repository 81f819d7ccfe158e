// Compares the exponential function and the logarithm of the core with those of the C library in
// double precision.
#include "core/math/exponential.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace dotpose::core_test::exponential_test {
namespace {

constexpr double kMaxError = 0x1p-22;

TEST(Exponential, ExpIsAccurate) {
    for (float x = -86.9F; x < 88; x += 0.00137F) {
        const double expected = std::exp(static_cast<double>(x));
        ASSERT_NEAR(static_cast<double>(core::natural_exp(x)) / expected, 1, kMaxError) << x;
    }
    EXPECT_EQ(core::natural_exp(0), 1);
    EXPECT_EQ(core::natural_exp(-87), 0);
    EXPECT_EQ(core::natural_exp(-1e30F), 0);
}

TEST(Exponential, LogIsAccurate) {
    for (float x = 1.2e-38F; x < 3e38F; x *= 1.0007F) {
        const double expected = std::log(static_cast<double>(x));
        ASSERT_NEAR(static_cast<double>(core::natural_log(x)), expected,
                    kMaxError * std::fmax(1, std::fabs(expected)))
            << x;
    }
    EXPECT_EQ(core::natural_log(1), 0);
}

}  // namespace
}  // namespace dotpose::core_test::exponential_test

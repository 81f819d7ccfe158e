// Tests that `position_at` recovers a position from its remainders modulo the lengths of the four
// sequences.
#include "code/basis.hpp"

#include <gtest/gtest.h>

#include "reference.hpp"

namespace dotpose::code_test::basis_test {
namespace {

TEST(PositionAt, IsThePositionThatLeavesTheseRemainders) {
    std::mt19937 rng(53);
    std::vector<std::uint32_t> positions{0, 1, 235, 236, kPositionsPerAxis - 1};
    for (int i = 0; i < 1000; ++i)
        positions.push_back(static_cast<std::uint32_t>(rng() % kPositionsPerAxis));
    for (const CodeVariant code : kCodeVariants) {
        for (const std::uint32_t p : positions)
            ASSERT_EQ(code::position_at(code::basis(code), {p % 236, p % 233, p % 31, p % 241}), p);
    }
}

}  // namespace
}  // namespace dotpose::code_test::basis_test

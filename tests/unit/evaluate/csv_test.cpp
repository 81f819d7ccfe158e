#include "evaluate/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dotpose::csv {
namespace {

using testing::ElementsAre;

TEST(Csv, CellsStandBetweenCommas) {
    EXPECT_THAT(cells_of("a,b,c"), ElementsAre("a", "b", "c"));
    EXPECT_THAT(cells_of(",x,,"), ElementsAre("", "x", "", ""));
    EXPECT_THAT(cells_of(""), ElementsAre(""));
    EXPECT_THAT(cells_of(" a ,\tb\r"), ElementsAre(" a ", "\tb\r"));
}

TEST(Csv, QuotedCellsMayHoldCommasAndDoubledQuotes) {
    EXPECT_THAT(cells_of(R"("a,b",c)"), ElementsAre("a,b", "c"));
    EXPECT_THAT(cells_of(R"("say ""yes"", please",2)"), ElementsAre(R"(say "yes", please)", "2"));
    EXPECT_THAT(cells_of(R"("",""""," ")"), ElementsAre("", "\"", " "));
}

}  // namespace
}  // namespace dotpose::csv

#include "nearest_name.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace dotpose::cli {
namespace {

TEST(EditDistance, CountsSingleChanges) {
    EXPECT_EQ(edit_distance("locate", "locate"), 0);
    EXPECT_EQ(edit_distance("locate", "lokate"), 1);   // replaced
    EXPECT_EQ(edit_distance("locate", "locte"), 1);    // removed
    EXPECT_EQ(edit_distance("locate", "loccate"), 1);  // inserted
    EXPECT_EQ(edit_distance("locate", "loacte"), 1);   // transposed
    EXPECT_EQ(edit_distance("", "abc"), 3);
    EXPECT_EQ(edit_distance("", ""), 0);
}

TEST(EditDistance, KnownPairs) {
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
    EXPECT_EQ(edit_distance("saturday", "sunday"), 3);
    EXPECT_EQ(edit_distance("sunday", "saturday"), 3);
    // The distance would be 2 if a letter could be inserted between transposed letters.
    EXPECT_EQ(edit_distance("ca", "abc"), 3);
}

const std::vector<std::string> kCommands = {"locate",      "print",     "simulate", "evaluate",
                                            "check-print", "calibrate", "watch"};

TEST(NearestName, OfAMisspeltWord) {
    EXPECT_EQ(nearest_name("lokate", kCommands), "locate");
    EXPECT_EQ(nearest_name("calibarte", kCommands), "calibrate");
    EXPECT_EQ(nearest_name("prnit", kCommands), "print");
    EXPECT_EQ(nearest_name("check_print", kCommands), "check-print");
    EXPECT_EQ(nearest_name("Watch", kCommands), "watch");
}

TEST(NearestName, OfTheBeginningOfOne) {
    EXPECT_EQ(nearest_name("cal", kCommands), "calibrate");
    EXPECT_EQ(nearest_name("sim", kCommands), "simulate");
    EXPECT_EQ(nearest_name("c", kCommands), "");
    EXPECT_EQ(nearest_name("ch", {"check-print", "chart-of-errors"}), "") << "it may be either";
}

TEST(NearestName, NoneForAnotherWord) {
    EXPECT_EQ(nearest_name("banana", kCommands), "");
    EXPECT_EQ(nearest_name("frame.png", kCommands), "");
    EXPECT_EQ(nearest_name("", kCommands), "");
    EXPECT_EQ(nearest_name(std::string(100'000, 'x'), kCommands), "");
    EXPECT_EQ(nearest_name("locate", {}), "");
}

TEST(NearestName, HyphensAtTheStartDoNotCount) {
    const std::vector<std::string> options = {"--help", "--out", "--format"};
    EXPECT_EQ(nearest_name("--formta", options), "--format");
    EXPECT_EQ(nearest_name("-out", options), "--out");
    EXPECT_EQ(nearest_name("--ot", options), "--out");
    EXPECT_EQ(nearest_name("-x", options), "");
    EXPECT_EQ(nearest_name("--", options), "");
}

TEST(NearestName, AsAQuestion) {
    EXPECT_EQ(did_you_mean("lokate", kCommands), "; did you mean 'locate'?");
    EXPECT_EQ(did_you_mean("banana", kCommands), "");
}

}  // namespace
}  // namespace dotpose::cli

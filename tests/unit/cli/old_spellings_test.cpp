// Options as earlier versions spelt them.
#include "old_spellings.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dotpose::cli {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Words = std::vector<std::string>;

Words renewed(const Words& words) {
    return in_new_spelling(words).words;
}

TEST(OldSpellings, AreReplaced) {
    EXPECT_THAT(renewed({"locate", "--format", "jsonl", "a.png"}),
                ElementsAre("locate", "--format", "json", "a.png"));
    EXPECT_THAT(renewed({"listen", "--format=jsonl"}), ElementsAre("listen", "--format", "json"));
    EXPECT_THAT(renewed({"watch", "0", "--map", "a.svg"}),
                ElementsAre("watch", "0", "--draw", "a.svg"));
    EXPECT_THAT(renewed({"fleet", "--map=a.svg"}), ElementsAre("fleet", "--draw=a.svg"));
    EXPECT_THAT(renewed({"simulate", "--paper", "200"}),
                ElementsAre("simulate", "--paper-level", "200"));
    EXPECT_THAT(renewed({"optics", "--paper"}), ElementsAre("optics", "--device", "paper"));
    EXPECT_THAT(renewed({"evaluate", "frames", "--json"}),
                ElementsAre("evaluate", "frames", "--format", "json"));
    EXPECT_THAT(renewed({"replay", "a.csv", "-o", "a.svg", "--json"}),
                ElementsAre("replay", "a.csv", "--draw", "a.svg", "--format", "json"));
    for (const std::string out : {"--out=map.svg", "-omap.svg"}) {
        EXPECT_THAT(renewed({"check-print", out}), ElementsAre("check-print", "--draw", "map.svg"));
    }
    EXPECT_THAT(renewed({"check-print", "a.png", "--out", "map.svg"}),
                ElementsAre("check-print", "a.png", "--draw", "map.svg"));
}

TEST(OldSpellings, OfOneCommandStayInOthers) {
    for (const Words& words :
         {Words{}, Words{"--help"}, Words{"print", "--paper", "A4"}, Words{"print", "-o", "a.svg"},
          Words{"locate", "--format", "csv"}, Words{"replay", "a.csv", "-o", "a.json"},
          Words{"replay", "-o"}, Words{"check-print", "-out.svg"}, Words{"listen", "--format"},
          Words{"evaluate", "--", "--json"}}) {
        const Respelt line = in_new_spelling(words);
        EXPECT_EQ(line.words, words);
        EXPECT_THAT(line.notes, IsEmpty());
    }
}

TEST(OldSpellings, AreNotedOnce) {
    EXPECT_THAT(in_new_spelling({"watch", "--map", "a.svg", "--map", "b.svg"}).notes,
                ElementsAre("note: --map is now --draw; the earlier spelling works until the next "
                            "release"));
}

}  // namespace
}  // namespace dotpose::cli

// Tests the colouring of reports and the formatting of durations.
#include "terminal_text.hpp"

#include <gtest/gtest.h>

#include "progress.hpp"

namespace dotpose::cli {
namespace {

TEST(TerminalText, ColoursWhatIsWrongOrWellAtTheBeginningOfALine) {
    EXPECT_EQ(in_colour("scale x FAULT: no\nFAULT: small\nnote: scan at 600 dpi\n"),
              "scale x FAULT: no\n\033[31mFAULT:\033[0m small\n\033[33mnote:\033[0m scan at 600 "
              "dpi\n");
    EXPECT_EQ(in_colour("verdict     good: all well"), "\033[32mverdict     good\033[0m: all well");
    EXPECT_EQ(in_colour("verdict     drifted: x\n\n"), "\033[31mverdict\033[0m     drifted: x\n\n");
    EXPECT_EQ(in_colour(""), "");
}

TEST(TerminalText, WantsNoColourInAFile) {
    std::FILE* const file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    EXPECT_FALSE(wants_colour(file));
    std::fclose(file);
}

TEST(DurationText, HasTwoUnitsAtMostAndIsRoundedUp) {
    EXPECT_EQ(duration_text(0), "0 s");
    EXPECT_EQ(duration_text(0.1), "1 s");
    EXPECT_EQ(duration_text(59.0), "59 s");
    EXPECT_EQ(duration_text(59.5), "1 min 00 s");
    EXPECT_EQ(duration_text(185), "3 min 05 s");
    EXPECT_EQ(duration_text(3600), "1 h 00 min");
    EXPECT_EQ(duration_text(2 * 3600 + 9 * 60 + 1), "2 h 10 min");
}

}  // namespace
}  // namespace dotpose::cli

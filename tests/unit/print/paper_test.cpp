#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"

namespace dotpose {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

void expect_size(const char* name, double width_mm, double height_mm) {
    const Paper paper = paper_by_name(name);
    EXPECT_DOUBLE_EQ(paper.width_mm, width_mm) << name;
    EXPECT_DOUBLE_EQ(paper.height_mm, height_mm) << name;
}

TEST(paper, knows_all_names) {
    expect_size("A0", 841, 1189);
    expect_size("A1", 594, 841);
    expect_size("A2", 420, 594);
    expect_size("A3", 297, 420);
    expect_size("A4", 210, 297);
    expect_size("A5", 148, 210);
    expect_size("A6", 105, 148);
    expect_size("Letter", 8.5 * 25.4, 11 * 25.4);
    expect_size("Legal", 8.5 * 25.4, 14 * 25.4);
    expect_size("Tabloid", 11 * 25.4, 17 * 25.4);
    expect_size("a4", 210, 297);
    expect_size("LETTER", 8.5 * 25.4, 11 * 25.4);
}

TEST(paper, takes_a_size_in_mm) {
    expect_size("100x62.5", 100, 62.5);
    expect_size("62.5X100", 62.5, 100);
    expect_size("100000x1", 100'000, 1);
}

TEST(paper, refuses_what_it_does_not_know) {
    for (const char* name :
         {"", "A7", "A44", "x", "100x", "x100", "100 x 50", "100x50mm", "1x2x3", "0xnanx", "A4x"}) {
        EXPECT_THAT([&] { (void)paper_by_name(name); },
                    ThrowsMessage<BadArgument>(HasSubstr("unknown paper size '")))
            << name;
    }
}

TEST(paper, refuses_impossible_sizes) {
    for (const char* name : {"0x100", "-1x100", "100x0", "100x100001", "nanx100", "infx100"}) {
        EXPECT_THAT([&] { (void)paper_by_name(name); },
                    ThrowsMessage<BadArgument>(HasSubstr("each side must be over 0 and at most")))
            << name;
    }
}

TEST(paper, landscape_turns_only_portrait_pages) {
    const Paper turned = landscape({.width_mm = 210, .height_mm = 297});
    EXPECT_EQ(turned.width_mm, 297);
    EXPECT_EQ(turned.height_mm, 210);
    EXPECT_EQ(landscape(turned).width_mm, 297);
}

}  // namespace
}  // namespace dotpose

// Tests the files that contain the ink of a pen.
#include "dotpose/tools/ink.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../inkml_check.hpp"
#include "../../xml_check.hpp"

namespace dotpose {
namespace {

using ::testing::HasSubstr;

/// Returns a page with a stroke from (1, 2) to (3, 5) mm, and a dot.
InkPage small_page() {
    InkPage page;
    page.name = "A & B";
    page.width_mm = 210;
    page.height_mm = 297;
    page.strokes = {{{0.5, 1, 2, 0, 0}, {0.505, 3, 5, 0, 0}}, {{1, 7, 8, 0.5, 0}}};
    return page;
}

TEST(InkSvg, HasTheSizeOfThePage) {
    const std::string svg = ink_svg(small_page());
    EXPECT_EQ(test::XmlCheck(svg).problem(), "");
    EXPECT_THAT(svg, HasSubstr(R"(width="210mm" height="297mm" viewBox="0 0 210 297")"));
    EXPECT_THAT(svg, HasSubstr(R"(d="M1.0000 2.0000 L3.0000 5.0000")"));
    EXPECT_THAT(svg, HasSubstr("A &amp; B"));
}

TEST(InkSvg, WithoutAPageContainsAllStrokes) {
    InkPage page = small_page();
    page.width_mm = 0;
    for (InkStroke& stroke : page.strokes) {
        for (InkPoint& point : stroke)
            point.x_mm += 1e8;
    }
    const std::string svg = ink_svg(page);
    // The strokes span 6 mm x 6 mm, and the margin is 5 mm.
    EXPECT_THAT(svg, HasSubstr(R"(width="16mm" height="16mm")"));
    EXPECT_THAT(svg, HasSubstr(R"(d="M5.0000 5.0000 L7.0000 8.0000")"));
}

TEST(InkMl, HasTracesInTheNamespace) {
    const std::string ink = ink_ml(small_page());
    EXPECT_EQ(test::XmlCheck(ink).problem(), "");
    EXPECT_THAT(ink, HasSubstr(R"(<ink xmlns="http://www.w3.org/2003/InkML">)"));
    EXPECT_THAT(ink, HasSubstr(R"(<trace contextRef="#page">1.0000 2.0000 500.000 0.00 0.00, )"
                               R"(3.0000 5.0000 505.000 0.00 0.00</trace>)"));
    // The pen leans by 0.5 rad towards +x.
    EXPECT_THAT(ink, HasSubstr("7.0000 8.0000 1000.000 28.65 0.00</trace>"));
}

TEST(InkMl, IsValid) {
    const test::InkMlCheck small(ink_ml(small_page()));
    EXPECT_EQ(small.problem(), "");
    EXPECT_EQ(small.traces(), 2);
    // The strokes begin outside the page, as if the pen had left it.
    InkPage page = small_page();
    page.strokes[0].front().x_mm = -1;
    page.strokes[1].front().y_mm = 298;
    EXPECT_EQ(test::InkMlCheck(ink_ml(page)).problem(), "");
}

}  // namespace
}  // namespace dotpose

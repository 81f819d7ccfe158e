// Tests the conversion of drawings to pixels: the size, and the position of the content.
#include "evaluate/raster.hpp"

#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../temporary_directory.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/image_file.hpp"
#include "draw/svg.hpp"

namespace dotpose {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Returns a drawing of 30 x 20 units, black from (10, 5) to (20, 10).
std::string drawing() {
    draw::Svg svg(30, 20, "a bar");
    svg.add(R"(<rect x="10" y="5" width="10" height="5" fill="#000000"/>)");
    return std::move(svg).finish();
}

TEST(Raster, HasTwoPixelsToTheUnit) {
    const test::TemporaryDirectory folder;
    draw::write_png(folder.path() / "bar.png", drawing());
    const GreyImage image = read_image(folder.path() / "bar.png");
    ASSERT_EQ(image.width_px, 60);
    ASSERT_EQ(image.height_px, 40);
    for (int v = 0; v < 40; ++v) {
        for (int u = 0; u < 60; ++u) {
            const bool is_black = u >= 20 && u < 40 && v >= 10 && v < 20;
            ASSERT_EQ(image.view().row(v)[u], is_black ? 0 : 255) << u << ", " << v;
        }
    }
}

TEST(Raster, AFigureIsWrittenInBothWays) {
    const test::TemporaryDirectory folder;
    draw::write_figure(folder.path(), "bar", [](std::ostream& out) { out << drawing(); });
    std::ifstream svg(folder.path() / "bar.svg");
    EXPECT_EQ(std::string(std::istreambuf_iterator(svg), {}), drawing());
    EXPECT_EQ(read_image(folder.path() / "bar.png").width_px, 60);
}

TEST(Raster, WhatCannotBeDrawnOrWrittenIsNamed) {
    const test::TemporaryDirectory folder;
    EXPECT_THAT([&] { draw::write_png(folder.path() / "text.png", "no drawing"); },
                ThrowsMessage<Error>(HasSubstr("text.png")));
    EXPECT_THAT([&] { draw::write_png(folder.path() / "missing" / "bar.png", drawing()); },
                ThrowsMessage<Error>(HasSubstr("bar.png")));
}

}  // namespace
}  // namespace dotpose

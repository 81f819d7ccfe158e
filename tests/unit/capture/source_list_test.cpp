// Tests the cropping of images to a region.
#include "capture/source_list.hpp"

#include <gtest/gtest.h>

namespace dotpose::capture {
namespace {

TEST(Cropped, IsThePartAsked) {
    GreyImage image{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 4, 3};
    const GreyImage part = cropped(image, {1, 1, 2, 2});
    EXPECT_EQ(part.width_px, 2);
    EXPECT_EQ(part.height_px, 2);
    EXPECT_EQ(part.pixels, (std::vector<std::uint8_t>{5, 6, 9, 10}));
    EXPECT_EQ(cropped(image, {0, 0, 4, 3}).pixels, image.pixels);
    for (const Region& bad :
         {Region{3, 0, 2, 1}, Region{0, 2, 1, 2}, Region{-1, 0, 1, 1}, Region{0, 0, 0, 1}}) {
        EXPECT_THROW(cropped(image, bad), BadArgument);
    }
}

}  // namespace
}  // namespace dotpose::capture

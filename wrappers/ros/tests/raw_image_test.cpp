// Tests the conversion of ROS encodings to grey images.
#include "raw_image.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <dotpose/files/error.hpp>

namespace dotpose_ros {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using Bytes = std::vector<std::uint8_t>;

/// Returns the grey levels of an image with `height` rows.
Bytes grey(const std::string& encoding, std::uint32_t width, const Bytes& data,
           bool is_bigendian = false, std::uint32_t height = 1) {
    const auto step = static_cast<std::uint32_t>(data.size() / height);
    dotpose::GreyImage buffer;
    const dotpose::ImageView view =
        grey_view({encoding, width, height, step, is_bigendian, data}, buffer);
    EXPECT_EQ(view.width_px, static_cast<int>(width));
    EXPECT_EQ(view.height_px, static_cast<int>(height));
    Bytes levels;
    for (int v = 0; v < view.height_px; ++v)
        levels.insert(levels.end(), view.row(v), view.row(v) + view.width_px);
    return levels;
}

std::string problem_of(const RawImage& image) {
    dotpose::GreyImage buffer;
    try {
        grey_view(image, buffer);
    } catch (const dotpose::Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(RosRawImage, GreyIsNotCopied) {
    const Bytes data(64 * 70);
    dotpose::GreyImage buffer;
    for (const char* encoding : {"mono8", "8UC1", "nv12"}) {
        const auto view = grey_view({encoding, 64, 70, 64, false, data}, buffer);
        EXPECT_EQ(view.pixels, data.data()) << encoding;
        EXPECT_EQ(view.stride_bytes, 64) << encoding;
    }
}

TEST(RosRawImage, ColoursBecomeTheirLuma) {
    // Luma of red, green, blue and white according to Rec. 601.
    const auto expected = ElementsAre(76, 150, 29, 255);
    EXPECT_THAT(grey("rgb8", 4, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}), expected);
    EXPECT_THAT(grey("bgr8", 4, {0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255}), expected);
    EXPECT_THAT(grey("bgra8", 4, {0, 0, 255, 7, 0, 255, 0, 7, 255, 0, 0, 7, 255, 255, 255, 7}),
                expected);
}

TEST(RosRawImage, LumaOfYuvIsEverySecondByte) {
    EXPECT_THAT(grey("yuv422", 2, {128, 10, 128, 20}), ElementsAre(10, 20));
    EXPECT_THAT(grey("uyvy", 2, {128, 10, 128, 20}), ElementsAre(10, 20));
    EXPECT_THAT(grey("yuv422_yuy2", 2, {10, 128, 20, 128}), ElementsAre(10, 20));
}

TEST(RosRawImage, SixteenBitsMayHoldTwelve) {
    // The 12-bit levels 4095, 2048 and 16, in both byte orders.
    EXPECT_THAT(grey("mono16", 3, {0xFF, 0x0F, 0x00, 0x08, 0x10, 0x00}), ElementsAre(255, 128, 1));
    EXPECT_THAT(grey("mono16", 3, {0x0F, 0xFF, 0x08, 0x00, 0x00, 0x10}, true),
                ElementsAre(255, 128, 1));
    // These levels use all 16 bits.
    EXPECT_THAT(grey("mono16", 2, {0xFF, 0xFF, 0x00, 0x80}), ElementsAre(255, 128));
}

TEST(RosRawImage, AMosaicOfOneColourIsEvenGrey) {
    // A mosaic of red 200, green 100 and blue 40. The mean is (200 + 2 * 100 + 40) / 4.
    const Bytes rggb = {200, 100, 200, 100, 100, 40, 100, 40, 200, 100, 200, 100, 100, 40, 100, 40};
    for (const std::uint8_t level : grey("bayer_rggb8", 4, rggb, false, 4))
        EXPECT_EQ(level, 110);
}

TEST(RosRawImage, SaysWhatIsWrongAndWhatToDo) {
    const Bytes data(640 * 480);
    EXPECT_THAT(problem_of({"32FC1", 64, 64, 256, false, data}),
                AllOf(HasSubstr("'32FC1'"), HasSubstr("set the camera's driver to mono8")));
    // Invalid sizes: rows longer than the step, too few rows in the data, no pixels, and rows far
    // longer than the step.
    const auto is_size = AllOf(HasSubstr("640 x 480 px in bgr8 need a step of 1920"),
                               HasSubstr("these have a step of"), HasSubstr("correct width"));
    EXPECT_THAT(problem_of({"bgr8", 640, 480, 640, false, data}), is_size);
    EXPECT_THAT(problem_of({"bgr8", 640, 480, 1920, false, data}), is_size);
    EXPECT_THAT(problem_of({"mono8", 0, 0, 0, false, {}}), HasSubstr("0 x 0 px"));
    EXPECT_THAT(problem_of({"mono8", 4'000'000'000, 4'000'000'000, 4, false, data}),
                HasSubstr("correct width"));
}

}  // namespace
}  // namespace dotpose_ros

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "../../jpeg.hpp"
#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/print.hpp"
#include "encoders.hpp"

namespace dotpose {
namespace {

class ResolutionTest : public testing::Test {
  protected:
    ResolutionTest() {
        std::string pattern = (std::filesystem::temp_directory_path() / "dotpose-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) throw Error("no temporary directory");
        directory_ = pattern;
    }
    ~ResolutionTest() override { std::filesystem::remove_all(directory_); }

    std::optional<Resolution> resolution_of(const std::string& content) const {
        const auto path = directory_ / "image";
        std::ofstream(path, std::ios::binary) << content;
        return read_resolution(path);
    }
    std::optional<Resolution> resolution_of(const test::Bytes& content) const {
        return resolution_of(std::string(content.begin(), content.end()));
    }

    std::filesystem::path directory_;
    GreyImage image_{std::vector<std::uint8_t>(16 * 16, 200), 16, 16};
};

TEST_F(ResolutionTest, is_read_from_png_and_tiff) {
    SheetOptions options;
    options.paper = {20, 20};
    PrintOptions print;
    for (const double dpi : {300.0, 600.0, 1200.0}) {
        print.dpi = dpi;
        for (const char* name : {"sheet.png", "sheet.tif"}) {
            write_sheet(make_sheet(options), directory_ / name, print);
            const auto resolution = read_resolution(directory_ / name);
            ASSERT_TRUE(resolution) << name;
            // PNG counts whole pixels per metre.
            EXPECT_NEAR(resolution->x_dpi, dpi, 0.013) << name;
            EXPECT_NEAR(resolution->y_dpi, dpi, 0.013) << name;
        }
    }
}

TEST_F(ResolutionTest, is_read_from_jpeg) {
    const auto resolution = resolution_of(test::jpeg_of(image_, 90, 300));
    ASSERT_TRUE(resolution);
    EXPECT_DOUBLE_EQ(resolution->x_dpi, 300);
    EXPECT_DOUBLE_EQ(resolution->y_dpi, 300);
}

TEST_F(ResolutionTest, is_nothing_where_a_file_states_none) {
    test::Raster raster{4, 4, 1, 8, std::vector<std::uint16_t>(16, 100)};
    EXPECT_FALSE(resolution_of(test::jpeg_of(image_, 90)));
    EXPECT_FALSE(resolution_of(test::encode_png(raster)));
    EXPECT_FALSE(resolution_of(test::encode_tiff(raster, true)));
    EXPECT_FALSE(resolution_of(test::encode_pnm(raster, false, 255)));
}

TEST_F(ResolutionTest, of_a_file_that_is_no_image_is_an_error) {
    EXPECT_THROW(resolution_of(std::string("not an image")), Error);
    EXPECT_THROW(read_resolution(directory_ / "missing"), Error);
}

}  // namespace
}  // namespace dotpose

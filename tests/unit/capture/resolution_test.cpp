#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "../../exif.hpp"
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

    ImageOrigin origin_of(const std::string& content) const {
        const auto path = directory_ / "image";
        std::ofstream(path, std::ios::binary) << content;
        return read_origin(path);
    }
    std::optional<Resolution> resolution_of(const std::string& content) const {
        return origin_of(content).resolution;
    }
    std::optional<Resolution> resolution_of(const test::Bytes& content) const {
        return resolution_of(std::string(content.begin(), content.end()));
    }

    /// Returns true if a file with this content can be read and is a photo.
    bool is_photo(const test::Bytes& content) const {
        try {
            return origin_of(std::string(content.begin(), content.end())).is_photo;
        } catch (const Error&) {
            return false;
        }
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
            const auto resolution = read_origin(directory_ / name).resolution;
            ASSERT_TRUE(resolution) << name;
            // PNG stores an integer number of pixels per metre, so the error is up to 0.5 px/m,
            // which is 0.0127 dpi.
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

TEST_F(ResolutionTest, is_nothing_where_it_is_a_screens) {
    for (const int dpi : {72, 96}) {
        EXPECT_FALSE(resolution_of(test::jpeg_of(image_, 90, dpi))) << dpi;
        EXPECT_FALSE(origin_of(test::jpeg_of(image_, 90, dpi)).is_photo) << dpi;
    }
    EXPECT_TRUE(resolution_of(test::jpeg_of(image_, 90, 75)));
}

TEST_F(ResolutionTest, is_nothing_where_a_camera_took_the_image) {
    const std::string jpeg = test::jpeg_of(image_, 90, 300);
    for (const std::uint16_t tag :
         {test::exposure_time, test::f_number, test::sensitivity, test::focal_length}) {
        for (const bool big_endian : {false, true}) {
            const std::string exif = test::exif_of({test::date_taken, tag}, big_endian);
            for (const std::size_t position : {2U, 20U}) {
                const ImageOrigin origin = origin_of(test::with_exif(jpeg, exif, position));
                EXPECT_TRUE(origin.is_photo) << tag;
                EXPECT_FALSE(origin.resolution) << tag;
            }
        }
    }
}

TEST_F(ResolutionTest, is_that_of_a_scan_whose_exif_data_have_no_exposure) {
    for (const bool big_endian : {false, true}) {
        const std::string exif = test::exif_of({test::date_taken, test::file_source}, big_endian);
        const ImageOrigin origin = origin_of(test::with_exif(test::jpeg_of(image_, 90, 300), exif));
        EXPECT_FALSE(origin.is_photo);
        ASSERT_TRUE(origin.resolution);
        EXPECT_EQ(origin.resolution->x_dpi, 300);
    }
}

TEST_F(ResolutionTest, finds_a_camera_in_png_and_tiff) {
    test::Raster raster{4, 4, 1, 8, std::vector<std::uint16_t>(16, 100)};
    const std::string exif = test::exif_of({test::f_number}, true);
    EXPECT_TRUE(is_photo(test::encode_png(raster, {}, {exif.begin(), exif.end()})));
    EXPECT_FALSE(is_photo(test::encode_png(raster)));
    EXPECT_TRUE(is_photo({exif.begin(), exif.end()}));
    EXPECT_FALSE(is_photo(test::encode_tiff(raster, true)));
}

// The reader must not read beyond the end of truncated or invalid EXIF data. A sanitizer would
// report such a read. A camera tag before the end of truncated data may still be found.
TEST_F(ResolutionTest, survives_exif_data_that_are_damaged) {
    const std::string exif = test::exif_of({test::date_taken, test::focal_length}, false);
    const std::string jpeg = test::jpeg_of(image_, 90);
    for (std::size_t size = 0; size < exif.size(); ++size) {
        // True if the last entry is complete, that is, if at most the offset of the next directory
        // (4 bytes) is truncated.
        const bool is_whole = size + 4 >= exif.size();
        EXPECT_EQ(is_photo({exif.begin(), exif.begin() + static_cast<std::ptrdiff_t>(size)}),
                  is_whole)
            << size;
        EXPECT_EQ(origin_of(test::with_exif(jpeg, exif.substr(0, size))).is_photo, is_whole)
            << size;
    }
    const std::string photo = test::with_exif(jpeg, exif, 2);
    for (std::size_t at = 0; at < exif.size() + 12; ++at) {
        for (const int value : {0, 1, 127, 255}) {
            test::Bytes damaged(photo.begin(), photo.end());
            damaged[at] = static_cast<std::uint8_t>(value);
            static_cast<void>(is_photo(damaged));
        }
    }
}

TEST_F(ResolutionTest, of_a_file_that_is_no_image_is_an_error) {
    EXPECT_THROW(resolution_of(std::string("not an image")), Error);
    EXPECT_THROW(read_origin(directory_ / "missing"), Error);
}

}  // namespace
}  // namespace dotpose

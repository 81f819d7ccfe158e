// Tests rare kinds of image files. image_file_test.cpp tests the common kinds.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include "../../jpeg.hpp"
#include "../../temporary_directory.hpp"
#include "encoders.hpp"
#include "images/image_format.hpp"

namespace dotpose::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Bytes pixels_of(const Bytes& file) {
    std::string note;
    return images::format_of(file)->decode({file}, note).pixels;
}

std::string error_of(const Bytes& file) {
    try {
        pixels_of(file);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// Returns a BMP of 2 x 1 px with a 124-byte header that contains the four channel masks.
Bytes bmp_with_masks(std::uint64_t bits, std::uint64_t compression,
                     std::initializer_list<std::uint64_t> masks,
                     std::initializer_list<std::uint64_t> pixels, std::int32_t height = 1) {
    Writer bmp(false);
    bmp.text("BM").integers(4, {0, 0, 14 + 124, 124, 2, static_cast<std::uint32_t>(height)});
    bmp.integers(2, {1, bits}).integers(4, {compression, 0, 11811, 11811, 0, 0});
    bmp.integers(4, masks).bytes(Bytes(124 - 40 - 16, 0));
    return bmp.integers(static_cast<int>(bits / 8), pixels).data;
}

TEST(BmpKinds, HaveFieldsOfBits) {
    // Two pixels with opacity, as written by GIMP and ImageMagick. The first is opaque red, and the
    // second is half-transparent black.
    EXPECT_THAT(pixels_of(bmp_with_masks(32, 3, {0xFF0000, 0xFF00, 0xFF, 0xFF000000},
                                         {0xFFFF0000, 0x80000000})),
                ElementsAre(76, 127));
    // A white pixel and a pure green pixel, with five bits for red, six for green and five for
    // blue.
    EXPECT_THAT(pixels_of(bmp_with_masks(16, 3, {0xF800, 0x07E0, 0x001F, 0}, {0xFFFF, 0x07E0})),
                ElementsAre(255, 150));
    // The file has no masks, so the fourth byte of a pixel is ignored.
    EXPECT_THAT(pixels_of(bmp_with_masks(32, 0, {0, 0, 0, 0}, {0x00FFFFFF, 0x000000FF})),
                ElementsAre(255, 29));
}

TEST(BmpKinds, StartAtTheTopWhenTheHeightIsNegative) {
    const Bytes file = bmp_with_masks(32, 0, {0, 0, 0, 0}, {0, 0x010101, 0x020202, 0x030303}, -2);
    EXPECT_THAT(pixels_of(file), ElementsAre(0, 1, 2, 3));
}

TEST(BmpKinds, HaveFewBitsAndTheHeaderOfOs2) {
    // This image is 3 px wide and 1 px high. Its palette consists of two colours, blue and white,
    // with three bytes each.
    const Bytes file = Writer(false)
                           .text("BM")
                           .integers(4, {0, 0, 14 + 12 + 6, 12})
                           .integers(2, {3, 1, 1, 1})
                           .integers(1, {255, 0, 0, 255, 255, 255})
                           .integers(1, {0xA0, 0, 0, 0})
                           .data;
    EXPECT_THAT(pixels_of(file), ElementsAre(255, 29, 255));
}

TEST(BmpKinds, SayWhatIsNotRead) {
    EXPECT_THAT(error_of(bmp_with_masks(8, 1, {0, 0, 0, 0}, {0, 0, 0, 0})),
                HasSubstr("compressed pixels are not supported"));
    EXPECT_THAT(error_of(bmp_with_masks(24, 0, {0, 0, 0, 0}, {0})), HasSubstr("cut short"));
}

TEST(BmpKinds, StateTheirResolution) {
    const Bytes file = bmp_with_masks(32, 0, {0, 0, 0, 0}, {0, 0});
    const auto resolution = images::format_of(file)->origin({file}).resolution;
    ASSERT_TRUE(resolution);
    EXPECT_NEAR(resolution->x_dpi, 300, 0.01);
}

/// Fixture that writes TIFF files with images of 48 x 20 px.
class TiffKinds : public testing::Test {
  protected:
    static constexpr std::uint32_t kWidth = 48;
    static constexpr std::uint32_t kHeight = 20;

    template <typename SetTags>
    Bytes file_of(const SetTags& set_tags, const std::vector<std::uint16_t>& levels) const {
        const std::string path = folder_.path() / "image.tif";
        TIFF* tiff = TIFFOpen(path.c_str(), "w");
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kWidth);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kHeight);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 16);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
        set_tags(tiff);
        if (TIFFIsTiled(tiff) != 0) {
            write_tiles(tiff, levels);
        } else {
            const std::size_t per_row = levels.size() / kHeight;
            for (std::uint32_t v = 0; v < kHeight; ++v) {
                std::vector<std::uint16_t> row(levels.begin() + v * per_row,
                                               levels.begin() + (v + 1) * per_row);
                EXPECT_EQ(TIFFWriteScanline(tiff, row.data(), v, 0), 1);
            }
        }
        TIFFClose(tiff);
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    static void write_tiles(TIFF* tiff, const std::vector<std::uint16_t>& levels) {
        constexpr std::uint32_t kTile = 32;
        for (std::uint32_t v = 0; v < kHeight; v += kTile) {
            for (std::uint32_t u = 0; u < kWidth; u += kTile) {
                std::vector<std::uint16_t> tile(kTile * kTile, 0);
                for (std::uint32_t i = 0; i < kTile * kTile; ++i) {
                    const std::uint32_t row = v + i / kTile;
                    const std::uint32_t column = u + i % kTile;
                    if (row < kHeight && column < kWidth) tile[i] = levels[row * kWidth + column];
                }
                EXPECT_GE(TIFFWriteTile(tiff, tile.data(), u, v, 0, 0), 0);
            }
        }
    }

    TemporaryDirectory folder_;
};

TEST_F(TiffKinds, HaveTilesAndStripsOf16BitsAndCompression) {
    std::vector<std::uint16_t> levels(kWidth * kHeight);
    std::iota(levels.begin(), levels.end(),
              std::uint16_t{64});  // all below 1024, so samples use 10 bits
    Bytes expected;
    for (const std::uint16_t level : levels)
        expected.push_back(static_cast<std::uint8_t>((level * 255 + 511) / 1023));
    const auto tiles = [](TIFF* tiff) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 32);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, 32);
    };
    const auto strips = [](TIFF* tiff) {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 7);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
        TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_BOTRIGHT);  // ignored
    };
    for (const Bytes& file : {file_of(tiles, levels), file_of(strips, levels)}) {
        const Bytes pixels = pixels_of(file);
        ASSERT_EQ(pixels.size(), expected.size());
        for (std::size_t i = 0; i < pixels.size(); ++i)
            ASSERT_NEAR(pixels[i], expected[i], 1) << i;
        Bytes cut = file;
        cut.resize(file.size() / 2);
        EXPECT_NE(error_of(cut), "");
    }
}

TEST_F(TiffKinds, HaveColoursThatAreMultipliedByTheirOpacity) {
    std::vector<std::uint16_t> levels;
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
        levels.push_back(13107);  // a fifth of white, in a pixel with an opacity of two fifths
        levels.push_back(26214);
    }
    const auto opacity = [](TIFF* tiff) {
        const std::uint16_t kind = EXTRASAMPLE_ASSOCALPHA;
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 2);
        TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &kind);
    };
    const Bytes pixels = pixels_of(file_of(opacity, levels));
    // The premultiplied level is 1/5. The white paper behind the pixel adds 3/5.
    EXPECT_THAT(pixels, testing::Each(204));
}

TEST_F(TiffKinds, HaveFewBits) {
    // Each sample is one bit. In fax encodings, 1 is black.
    const std::vector<std::uint16_t> bits(kHeight * kWidth / 16, 0xFF00);
    const auto fax = [](TIFF* tiff) {
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 1);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISWHITE);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_CCITTFAX4);
    };
    const Bytes pixels = pixels_of(file_of(fax, bits));
    ASSERT_EQ(pixels.size(), kWidth * kHeight);
    EXPECT_EQ(pixels[0], 255);
    EXPECT_EQ(pixels[8], 0);
}

Bytes progressive_jpeg() {
    GreyImage image{{}, 64, 64};
    for (int v = 0; v < 64; ++v) {
        for (int u = 0; u < 64; ++u)
            image.pixels.push_back(static_cast<std::uint8_t>(v * 3 + u * u % 61));
    }
    const std::string file = jpeg_of(image, 75, 0, true);
    return {file.begin(), file.end()};
}

TEST(JpegKinds, AreProgressive) {
    const Bytes file = progressive_jpeg();
    EXPECT_EQ(pixels_of(file).size(), 64U * 64U);
}

// A truncated file must be rejected wherever it is truncated. This includes files that are
// truncated between two scans, which contain no reference to the missing scans.
TEST(JpegKinds, AreRefusedWhereAScanIsMissing) {
    const Bytes file = progressive_jpeg();
    int refused = 0;
    for (std::size_t size = file.size() / 4; size < file.size(); ++size) {
        const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
        refused += error_of(cut).find("cut short") != std::string::npos ? 1 : 0;
    }
    EXPECT_EQ(refused, static_cast<int>(file.size() - file.size() / 4));
}

// Decoding a file of a few kilobytes could take hours if it contained thousands of scans.
TEST(JpegKinds, AreRefusedWithTooManyScans) {
    Bytes file = progressive_jpeg();
    const Bytes marker{0xFF, 0xDA};
    const auto last = std::find_end(file.begin(), file.end(), marker.begin(), marker.end());
    const Bytes scan(last, file.end() - 2);
    for (int i = 0; i < 200; ++i)
        file.insert(file.end() - 2, scan.begin(), scan.end());
    EXPECT_THAT(error_of(file), HasSubstr("too many scans"));
}

}  // namespace
}  // namespace dotpose::test

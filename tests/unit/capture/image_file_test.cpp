#include "dotpose/tools/image_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "../../tiff_pages.hpp"
#include "encoders.hpp"

namespace dotpose::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class ImageFileTest : public testing::Test {
  protected:
    ImageFileTest() {
        std::string pattern = (std::filesystem::temp_directory_path() / "dotpose-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) throw Error("no temporary directory");
        directory = pattern;
    }
    ~ImageFileTest() override { std::filesystem::remove_all(directory); }

    std::filesystem::path write(const Bytes& bytes) const {
        auto path = directory / "image";  // no extension, because the reader must not depend on it
        // Removes the file before writing it again. Truncating it instead would make the test 10
        // times slower because some file systems flush truncated files.
        std::filesystem::remove(path);
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
        return path;
    }
    GreyImage read(const Bytes& bytes) const { return read_image(write(bytes)); }

    /// Returns the message of the Error that `read_image` throws, or "" if it throws none.
    static std::string error_of(const std::filesystem::path& path) {
        try {
            read_image(path);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    std::string error_of(const Bytes& bytes) const { return error_of(write(bytes)); }

    std::filesystem::path directory;
};

Bytes text(const std::string& content) {
    return {content.begin(), content.end()};
}

const Raster kGrey{4, 2, 1, 8, {0, 1, 2, 127, 128, 200, 254, 255}};
const Raster kGrey16{4, 1, 1, 16, {0, 128, 129, 65535}};
const Raster kRgb{5, 1, 3, 8, {255, 0, 0, 0, 255, 0, 0, 0, 255, 77, 77, 77, 255, 255, 0}};
const Raster kGreyOpacity{4, 1, 2, 8, {0, 255, 0, 0, 0, 128, 100, 51}};
const Raster kRgba{3, 1, 4, 8, {255, 0, 0, 255, 255, 0, 0, 0, 0, 0, 255, 204}};
const Raster kRgb16{2, 1, 3, 16, {65535, 0, 0, 1000, 1000, 1000}};
const Raster kIndexed{3, 1, 1, 8, {2, 0, 1}};
const Bytes kPalette{255, 0, 0, 9, 9, 9, 255, 255, 255};

// Expected grey levels. Luma is 0.299 R + 0.587 G + 0.114 B. Samples of 16 bits are divided by 257.
// Transparent pixels are blended with white.
const Bytes kGreyLevels{0, 1, 2, 127, 128, 200, 254, 255};
const Bytes kGrey16Levels{0, 0, 1, 255};
const Bytes kRgbLevels{76, 150, 29, 77, 226};
const Bytes kGreyOpacityLevels{0, 255, 127, 224};
const Bytes kRgbaLevels{76, 255, 74};
const Bytes kRgb16Levels{76, 4};
const Bytes kIndexedLevels{255, 76, 9};

TEST_F(ImageFileTest, reads_pnm) {
    for (const bool as_text : {false, true}) {
        const GreyImage image = read(encode_pnm(kGrey, as_text, 255));
        EXPECT_EQ(image.width_px, 4);
        EXPECT_EQ(image.height_px, 2);
        EXPECT_EQ(image.pixels, kGreyLevels);
        EXPECT_EQ(read(encode_pnm(kGrey16, as_text, 65535)).pixels, kGrey16Levels);
        EXPECT_EQ(read(encode_pnm(kRgb, as_text, 255)).pixels, kRgbLevels);
        EXPECT_EQ(read(encode_pnm(kRgb16, as_text, 65535)).pixels, kRgb16Levels);
        const Raster ten_bits{3, 1, 1, 16, {0, 512, 1023}};
        EXPECT_THAT(read(encode_pnm(ten_bits, as_text, 1023)).pixels, ElementsAre(0, 128, 255));
    }
    EXPECT_THAT(read(text("P2 #a\n#b\n2 1#c\n255\n9#d\r8\n")).pixels, ElementsAre(9, 8));
    EXPECT_THAT(read(text("P1\n3 1\n101\n")).pixels, ElementsAre(0, 255, 0));
    EXPECT_THAT(read(text("P4 3 2\n\xA0\x40")).pixels, ElementsAre(0, 255, 0, 255, 0, 255));
}

TEST_F(ImageFileTest, reads_png) {
    const GreyImage image = read(encode_png(kGrey));
    EXPECT_EQ(image.width_px, 4);
    EXPECT_EQ(image.height_px, 2);
    EXPECT_EQ(image.pixels, kGreyLevels);
    EXPECT_EQ(read(encode_png(kGrey16)).pixels, kGrey16Levels);
    EXPECT_EQ(read(encode_png(kRgb)).pixels, kRgbLevels);
    EXPECT_EQ(read(encode_png(kRgb16)).pixels, kRgb16Levels);
    EXPECT_EQ(read(encode_png(kGreyOpacity)).pixels, kGreyOpacityLevels);
    EXPECT_EQ(read(encode_png(kRgba)).pixels, kRgbaLevels);
    EXPECT_EQ(read(encode_png(kIndexed, kPalette)).pixels, kIndexedLevels);
    const Raster two_bits{4, 1, 1, 2, {0, 1, 2, 3}};
    EXPECT_THAT(read(encode_png(two_bits)).pixels, ElementsAre(0, 85, 170, 255));
}

TEST_F(ImageFileTest, reads_bmp) {
    const GreyImage image = read(encode_bmp(kRgb));
    EXPECT_EQ(image.width_px, 5);
    EXPECT_EQ(image.height_px, 1);
    EXPECT_EQ(image.pixels, kRgbLevels);
    EXPECT_EQ(read(encode_bmp(kIndexed, kPalette)).pixels, kIndexedLevels);
    Bytes greys;
    for (int level = 0; level < 256; ++level) {
        greys.insert(greys.end(), 3, static_cast<std::uint8_t>(level));
    }
    EXPECT_EQ(read(encode_bmp(kGrey, greys)).pixels, kGreyLevels);
}

TEST_F(ImageFileTest, reads_tiff) {
    for (const bool big_endian : {false, true}) {
        const GreyImage image = read(encode_tiff(kGrey, big_endian));
        EXPECT_EQ(image.width_px, 4);
        EXPECT_EQ(image.height_px, 2);
        EXPECT_EQ(image.pixels, kGreyLevels);
        EXPECT_EQ(read(encode_tiff(kGrey16, big_endian)).pixels, kGrey16Levels);
        EXPECT_EQ(read(encode_tiff(kRgb, big_endian)).pixels, kRgbLevels);
        EXPECT_EQ(read(encode_tiff(kRgb16, big_endian)).pixels, kRgb16Levels);
        EXPECT_EQ(read(encode_tiff(kGreyOpacity, big_endian)).pixels, kGreyOpacityLevels);
        EXPECT_EQ(read(encode_tiff(kRgba, big_endian)).pixels, kRgbaLevels);
        EXPECT_EQ(read(encode_tiff(kIndexed, big_endian, kPalette)).pixels, kIndexedLevels);
    }
}

TEST_F(ImageFileTest, reads_the_pages_of_tiff) {
    const GreyImage dark{Bytes(12, 10), 4, 3};
    const GreyImage light{Bytes(10, 200), 5, 2};
    const auto path = write(text(test::tiff_of_pages({dark, light}, 300)));
    EXPECT_EQ(count_pages(path), 2);
    EXPECT_EQ(read_image(path).pixels, dark.pixels);
    EXPECT_EQ(read_image(path, kDefaultImagePixels, 2).pixels, light.pixels);
    EXPECT_EQ(read_origin(path, 2).resolution->x_dpi, 300);
    EXPECT_THROW(read_image(path, kDefaultImagePixels, 3), Error);
    EXPECT_EQ(count_pages(write(encode_png(kGrey))), 1);
    // The second page refers to the first page as its next page.
    std::string loop = test::tiff_of_pages({dark, light}, 300);
    const std::size_t second = loop.size() - 10 - 8 - 4 - 12 * 11 - 2;
    loop[second + 2 + 12 * 11] = 8;
    EXPECT_EQ(count_pages(write(text(loop))), 2);
}

/// Returns the level of each block of 8 x 8 px. All pixels in a block must be equal.
Bytes block_levels(const GreyImage& image) {
    Bytes levels;
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            const std::uint8_t first = image.view().row(v / 8 * 8)[u / 8 * 8];
            EXPECT_EQ(image.view().row(v)[u], first);
            if (u % 8 == 0 && v % 8 == 0) levels.push_back(first);
        }
    }
    return levels;
}

TEST_F(ImageFileTest, reads_jpeg) {
    const GreyImage grey = read(encode_jpeg(kGrey));
    EXPECT_EQ(grey.width_px, 32);
    EXPECT_EQ(grey.height_px, 16);
    EXPECT_EQ(block_levels(grey), kGreyLevels);
    const Raster colour{3, 1, 3, 8, {0, 128, 128, 90, 128, 128, 255, 128, 128}};
    EXPECT_THAT(block_levels(read(encode_jpeg(colour))), ElementsAre(0, 90, 255));
    // The values are stored inverted, so 255 means no ink. The inks of the four pixels are: none,
    // full black, partial black, and full cyan, magenta and yellow.
    const Raster cmyk{4,
                      1,
                      4,
                      8,
                      {255, 255, 255, 255, 255, 255, 255, 0,  //
                       255, 255, 255, 100, 0, 0, 0, 255}};
    EXPECT_THAT(block_levels(read(encode_jpeg(cmyk))), ElementsAre(255, 0, 100, 0));
}

TEST_F(ImageFileTest, reads_the_longest_side) {
    const Raster row{kMaxImageSide_px, 1, 1, 8, std::vector<std::uint16_t>(kMaxImageSide_px, 255)};
    const Raster bits{kMaxImageSide_px, 1, 1, 1, std::vector<std::uint16_t>(kMaxImageSide_px, 1)};
    const Bytes white(768, 255);
    for (const Bytes& bytes : {encode_pnm(row, false, 255), encode_png(bits),
                               encode_tiff(row, false), encode_bmp(row, white)}) {
        const GreyImage image = read(bytes);
        EXPECT_EQ(image.width_px, kMaxImageSide_px);
        EXPECT_EQ(image.height_px, 1);
        EXPECT_EQ(std::ranges::count(image.pixels, 255), kMaxImageSide_px);
    }
}

TEST_F(ImageFileTest, refuses_too_large_images) {
    const int width = kMaxImageSide_px + 1;
    const auto count = static_cast<std::size_t>(width);
    const Raster row{width, 1, 1, 8, std::vector<std::uint16_t>(count, 0)};
    const Raster bits{width, 1, 1, 1, std::vector<std::uint16_t>(count, 1)};
    for (const Bytes& bytes :
         {encode_pnm(row, false, 255), encode_png(bits), encode_tiff(row, false),
          encode_bmp(row, Bytes(768, 255)), text("P5 16384 16385 255\n")}) {
        EXPECT_THAT(error_of(bytes), HasSubstr("the image is too large"));
    }
}

TEST_F(ImageFileTest, refuses_more_pixels_than_asked_for) {
    const Raster grey{8, 8, 1, 8, std::vector<std::uint16_t>(64, 255)};
    const Raster blocks{1, 1, 1, 8, {255}};  // one block of 8 x 8 px
    for (const Bytes& bytes :
         {encode_pnm(grey, false, 255), encode_png(grey), encode_tiff(grey, false),
          encode_bmp(grey, Bytes(768, 255)), encode_jpeg(blocks)}) {
        const auto path = write(bytes);
        EXPECT_EQ(read_image(path, 64).width_px, 8);
        try {
            read_image(path, 63);
            ADD_FAILURE() << "read";
        } catch (const ImageTooLarge& error) {
            EXPECT_EQ(error.width_px, 8);
            EXPECT_EQ(error.height_px, 8);
            EXPECT_THAT(error.what(), HasSubstr("the image is too large: 8 x 8 px"));
        }
    }
}

TEST_F(ImageFileTest, names_what_is_no_image_file) {
    const auto missing = directory / "missing.pgm";
    EXPECT_EQ(error_of(missing), "cannot read " + missing.string() + ": no such file");
    EXPECT_THAT(error_of(directory), HasSubstr("it is a directory"));
    EXPECT_THAT(error_of(Bytes{}), HasSubstr("the file is empty"));
    for (const char* other : {"P", "GIF89a", "P5", "P55 1 255", "%!PS-Adobe", "BMP", "<svg/>"}) {
        const std::string error = error_of(text(other));
        EXPECT_THAT(error, StartsWith("cannot read ")) << other;
    }
    EXPECT_THAT(error_of(text("%!PS-Adobe")),
                HasSubstr("not a PNM, PNG, JPEG, BMP, TIFF, WebP or HEIC image"));
}

TEST_F(ImageFileTest, names_formats_that_are_not_read_and_a_converter) {
    using namespace std::string_literals;
    EXPECT_THAT(
        error_of(text("GIF89a")),
        HasSubstr("a GIF image, which is not read: convert it first, for example with ffmpeg"));
    EXPECT_THAT(error_of(text("\0\0\0\x0cJXL \r\n\x87\n"s)), HasSubstr("a JPEG XL image"));
    EXPECT_THAT(error_of(text("\0\0\0\x0cjP  \r\n\x87\n"s)), HasSubstr("a JPEG 2000 image"));
    EXPECT_THAT(error_of(text("RIFF\x1a\0\0\0WAVE"s)), HasSubstr("not a PNM, PNG, JPEG"));
}

TEST_F(ImageFileTest, names_missing_permission) {
    if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
    const auto path = write(encode_png(kGrey));
    std::filesystem::permissions(path, std::filesystem::perms::none);
    EXPECT_THAT(error_of(path), HasSubstr("permission denied"));
}

struct Sample {
    const char* format;
    Bytes bytes;
};

std::vector<Sample> samples() {
    Raster noise{40, 30, 1, 8, {}};
    std::mt19937 random(7);
    for (int i = 0; i < 40 * 30; ++i) {
        noise.samples.push_back(static_cast<std::uint16_t>(random() & 255));
    }
    Raster blocks = noise;
    blocks.width_px = 10;
    blocks.height_px = 12;
    blocks.samples.resize(120);
    Bytes palette;
    for (int i = 0; i < 768; ++i)
        palette.push_back(static_cast<std::uint8_t>(random() & 255));
    return {{"PNM", encode_pnm(noise, false, 255)},
            {"PNM", encode_pnm(noise, true, 255)},
            {"PNG", encode_png(noise)},
            {"PNG", encode_png(noise, palette)},
            {"BMP", encode_bmp(noise, palette)},
            {"JPEG", encode_jpeg(blocks)},
            {"TIFF", encode_tiff(noise, false)},
            {"TIFF", encode_tiff(noise, true, palette)}};
}

TEST_F(ImageFileTest, refuses_files_cut_short) {
    for (const Sample& sample : samples()) {
        const std::size_t size = sample.bytes.size();
        // A JPEG image can be read without its two-byte end marker, so three bytes are removed.
        const std::size_t last = sample.format == std::string("JPEG") ? size - 3 : size - 1;
        for (const std::size_t kept : {size / 2, size * 95 / 100, last}) {
            Bytes cut = sample.bytes;
            cut.resize(kept);
            EXPECT_THAT(error_of(cut),
                        HasSubstr(std::string("the ") + sample.format + " image is cut short"))
                << kept << " of " << size << " bytes";
        }
    }
}

// Some cameras omit the end marker.
TEST_F(ImageFileTest, reads_a_jpeg_without_its_end_marker_and_says_so) {
    const Bytes whole = encode_jpeg(kGrey);
    std::string note = "of another image";
    read_image(write(whole), kDefaultImagePixels, note);
    EXPECT_EQ(note, "");
    for (const std::size_t missing : {1U, 2U}) {
        const Bytes cut(whole.begin(), whole.end() - static_cast<std::ptrdiff_t>(missing));
        const auto path = write(cut);
        EXPECT_EQ(block_levels(read_image(path, kDefaultImagePixels, note)), kGreyLevels);
        EXPECT_EQ(note, path.string() +
                            ": the JPEG image lacks its end marker; its pixels are "
                            "complete");
    }
}

// Sensors with 10 or 12 bits store their values in the lower bits of 16-bit samples.
TEST_F(ImageFileTest, scales_few_bits_in_16_by_the_bits_in_use) {
    const Raster ten{4, 1, 1, 16, {0, 512, 600, 1023}};
    const Raster twelve{4, 1, 1, 16, {0, 2048, 4000, 4095}};
    const Raster full{4, 1, 1, 16, {0, 2048, 4000, 4096}};
    const Bytes of_ten{0, 128, 150, 255};
    const Bytes of_twelve{0, 128, 249, 255};
    const Bytes of_full{0, 8, 16, 16};
    for (const auto& [raster, levels] :
         {std::pair{ten, of_ten}, std::pair{twelve, of_twelve}, std::pair{full, of_full}}) {
        EXPECT_EQ(read(encode_png(raster)).pixels, levels);
        EXPECT_EQ(read(encode_tiff(raster, false)).pixels, levels);
        EXPECT_EQ(read(encode_pnm(raster, false, 65535)).pixels, levels);
        EXPECT_EQ(read(encode_pnm(raster, true, 65535)).pixels, levels);
    }
    // If a PNM file declares a maximum value below 65535, the reader scales by that value instead
    // of by the bits in use.
    EXPECT_EQ(read(encode_pnm(ten, false, 1023)).pixels, of_ten);
    EXPECT_EQ(read(encode_pnm(ten, false, 40000)).pixels, (Bytes{0, 3, 4, 7}));
}

TEST_F(ImageFileTest, refuses_tiff_with_the_directory_cut) {
    // Moves the directory to the end of the file, as many writers do. The last word of the
    // directory, which refers to the next page, is then at the end of the file and is cut first.
    Bytes tiff = encode_tiff(kGrey, false);
    const std::size_t directory_bytes = 2 + 10 * 12 + 4;
    tiff.insert(tiff.end(), tiff.begin() + 8, tiff.begin() + 8 + directory_bytes);
    const std::size_t directory_at = tiff.size() - directory_bytes;
    tiff[4] = static_cast<std::uint8_t>(directory_at);
    ASSERT_LT(directory_at, 256U);
    EXPECT_EQ(read(tiff).pixels, kGreyLevels);
    tiff.pop_back();
    EXPECT_THAT(error_of(tiff), HasSubstr("the TIFF image is cut short"));
}

TEST_F(ImageFileTest, reads_headers_with_line_breaks_of_two_characters) {
    // The first pixel has the value 10, which is also the code of a line feed. Only the file size
    // shows whether this byte is a pixel or part of the header.
    const auto first_pixel = [this](const std::string& file) {
        std::ofstream(directory / "a.pgm", std::ios::binary) << file;
        return int{read_image(directory / "a.pgm").pixels.front()};
    };
    EXPECT_EQ(first_pixel("P5\r\n2 1\r\n255\r\n\x0a\x63"), 10);
    EXPECT_EQ(first_pixel("P5\r\n2 1\r\n255\r\n\x63\x0a"), 99);
    EXPECT_EQ(first_pixel("P5\r2 1\r255\r\x0a\x63"), 10);
    EXPECT_EQ(first_pixel("P5\n2 1\n255\n\x0a\x63"), 10);
}

TEST_F(ImageFileTest, refuses_damaged_files) {
    Bytes png = encode_png(kGrey);
    png[50] ^= 1;  // damages the pixels
    EXPECT_THAT(error_of(png), HasSubstr("the PNG image is damaged"));
    Bytes jpeg = encode_jpeg(kGrey);
    jpeg.insert(jpeg.end() - 6, {0xFF, 0xD0});  // a restart marker in the middle of the scan
    EXPECT_THAT(error_of(jpeg), HasSubstr("the JPEG image is damaged"));
    for (const char* header : {"P5 -3 4 255\n", "P5 3x 4 255\n", "P5 0 4 255\n", "P5 3 4 0\n",
                               "P5 3 4 99999\n", "P5 3 4 255x"}) {
        EXPECT_THAT(error_of(text(header + std::string(100, ' '))),
                    HasSubstr("the PNM image is damaged"))
            << header;
    }
    EXPECT_THAT(error_of(text("P2\n3 1\n255\n0 300 255\n")), HasSubstr("damaged"));
    EXPECT_THAT(error_of(text("P2\n3 1\n255\n0 x 255\n")), HasSubstr("damaged"));
}

TEST_F(ImageFileTest, survives_random_damage) {
    constexpr unsigned kSeed = 20240611;
    constexpr int kRounds = 2000;
    std::cout << "seed " << kSeed << "\n";
    std::mt19937 random(kSeed);
    for (const Sample& sample : samples()) {
        int refused = 0;
        for (int round = 0; round < kRounds; ++round) {
            Bytes bytes = sample.bytes;
            // Every other round damages only the first 200 bytes. These bytes contain the headers,
            // where damage has the largest effect.
            const std::size_t reach = round % 2 == 0 ? bytes.size() : std::size_t{200};
            for (std::uint32_t flips = 1 + random() % 8; flips > 0; --flips) {
                bytes[random() % reach] = static_cast<std::uint8_t>(random());
            }
            try {
                const GreyImage image = read(bytes);
                ASSERT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width_px) *
                                                   static_cast<std::size_t>(image.height_px));
                ASSERT_FALSE(image.pixels.empty());
            } catch (const Error& error) {
                ASSERT_THAT(error.what(), StartsWith("cannot read "));
                ++refused;
            }
        }
        std::cout << sample.format << ": " << refused << " of " << kRounds << " refused\n";
    }
}

TEST_F(ImageFileTest, writes_what_it_reads) {
    const Bytes padded{0, 128, 255, 99, 7, 8, 9, 99};
    const ImageView view{padded.data(), 3, 2, 4};
    const auto path = directory / "written";
    for (const auto& write_image : {write_pgm, write_png}) {
        write_image(path, view);
        const GreyImage image = read_image(path);
        EXPECT_EQ(image.width_px, 3);
        EXPECT_EQ(image.height_px, 2);
        EXPECT_THAT(image.pixels, ElementsAre(0, 128, 255, 7, 8, 9));
        EXPECT_THROW(write_image(path, {}), Error);
        EXPECT_THROW(write_image(directory, view), Error);
        EXPECT_THROW(write_image(directory / "missing" / "file", view), Error);
        if (std::filesystem::exists("/dev/full")) {
            EXPECT_THROW(write_image("/dev/full", view), Error);
        }
    }
}

}  // namespace
}  // namespace dotpose::test

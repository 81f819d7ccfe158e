// Tests the reading of WebP, HEIC and AVIF files that were written by the tools of libwebp and
// libheif.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../../exif.hpp"
#include "../../jpeg.hpp"
#include "../../shell.hpp"
#include "../../temporary_directory.hpp"
#include "dotpose/tools/image_file.hpp"
#include "encoders.hpp"

// Suppresses leak reports for the AVIF decoder. dav1d 1.0 leaks memory when it rejects damaged
// data.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libdav1d";
}

namespace dotpose::test {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Pointwise;

constexpr int kWidth_px = 64;
constexpr int kHeight_px = 48;

struct PhoneFormat {
    const char* name;
    /// Command for lossless encoding. `converted` appends the name of the image, `-o` and the name
    /// of the new file.
    const char* lossless;
    const char* photo;  ///< command for lossy encoding that keeps the EXIF data
};
constexpr const char* kLosslessHeif = "heif-enc -L -p chroma=444 --matrix_coefficients=0";
const PhoneFormat kPhoneFormats[] = {
    {"webp", "cwebp -quiet -lossless", "cwebp -quiet -metadata exif"},
    {"heic", kLosslessHeif, "heif-enc"},
    {"avif", kLosslessHeif, "heif-enc"},
};

class PhoneFormatTest : public testing::TestWithParam<PhoneFormat> {
  protected:
    void SetUp() override {
        const fs::path image = converted(GetParam().lossless, encode_png(noise()));
        if (!fs::exists(image))
            GTEST_SKIP() << "cannot write " << image << "; scripts/setup tests installs programs";
        if (error_of(image).find("which is not read") != std::string::npos)
            GTEST_SKIP() << "built without the library of this format";
    }

    /// Converts an image to the format, and returns the path of the new file. The file does not
    /// exist if the command failed.
    fs::path converted(const std::string& command, const Bytes& image,
                       const std::string& kind = ".png") const {
        const fs::path from = folder_.path() / ("image" + kind);
        const fs::path to = folder_.path() / (std::string("image.") + GetParam().name);
        write(from, image);
        fs::remove(to);
        run_shell(command + " '" + from.string() + "' -o '" + to.string() + "' 2>&1");
        return to;
    }
    static void write(const fs::path& path, const Bytes& bytes) {
        fs::remove(path);
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()),
                   static_cast<std::streamsize>(bytes.size()));
    }
    static Bytes bytes_of(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    static std::string error_of(const fs::path& path) {
        try {
            read_image(path);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    static Raster noise() {
        std::mt19937 random(7);
        Raster raster{kWidth_px, kHeight_px, 1, 8, {}};
        for (int i = 0; i < kWidth_px * kHeight_px; ++i)
            raster.samples.push_back(static_cast<std::uint16_t>(random() & 255));
        return raster;
    }

    TemporaryDirectory folder_;
};

TEST_P(PhoneFormatTest, GivesTheGreyLevels) {
    const Raster raster = noise();
    const GreyImage image = read_image(converted(GetParam().lossless, encode_png(raster)));
    EXPECT_EQ(image.width_px, kWidth_px);
    EXPECT_EQ(image.height_px, kHeight_px);
    EXPECT_THAT(image.pixels, Pointwise(testing::Eq(), raster.samples));
}

TEST_P(PhoneFormatTest, IsLaidOnWhitePaper) {
    Raster blue{16, 16, 4, 8, {}};
    for (int i = 0; i < 16 * 16; ++i)
        blue.samples.insert(blue.samples.end(), {0, 0, 255, 204});
    const GreyImage image = read_image(converted(GetParam().lossless, encode_png(blue)));
    // The luma of blue is 0.114 x 255. With an opacity of 0.8 on white, the level is 0.8 x luma +
    // 0.2 x 255.
    EXPECT_THAT(image.pixels, testing::Each(AnyOf(73, 74, 75)));
}

TEST_P(PhoneFormatTest, NamesThePhotosOfCameras) {
    const std::string jpeg = jpeg_of({Bytes(64 * 64, 90), 64, 64}, 90);
    for (const std::uint16_t tag : {exposure_time, date_taken}) {
        const std::string photo = with_exif(jpeg, exif_of({tag}, true));
        const fs::path image = converted(GetParam().photo, {photo.begin(), photo.end()}, ".jpg");
        EXPECT_EQ(read_origin(image).is_photo, tag == exposure_time);
        EXPECT_FALSE(read_origin(image).resolution);
    }
}

TEST_P(PhoneFormatTest, IsRefusedWhenItIsTooLarge) {
    const fs::path image = converted(GetParam().lossless, encode_png(noise()));
    EXPECT_EQ(read_image(image, kWidth_px * kHeight_px).width_px, kWidth_px);
    EXPECT_THROW(read_image(image, kWidth_px * kHeight_px - 1), ImageTooLarge);
}

// The reader refuses large images based on the size in the header, before decoding them.
TEST_P(PhoneFormatTest, IsRefusedWhenItsHeaderStatesAnotherSize) {
    const fs::path image = converted(GetParam().lossless, encode_png(noise()));
    Bytes file = bytes_of(image);
    const std::string_view size = "ispe";
    auto found = std::search(file.begin(), file.end(), size.begin(), size.end());
    if (found == file.end()) GTEST_SKIP() << "only HEIC and AVIF state the size twice";
    for (; found != file.end();
         found = std::search(found + 4, file.end(), size.begin(), size.end()))
        found[11] = kWidth_px / 2;
    write(image, file);
    EXPECT_THAT(error_of(image), HasSubstr("its header states another size"));
}

TEST_P(PhoneFormatTest, IsRefusedWhenItIsCutShort) {
    const fs::path image = converted(GetParam().lossless, encode_png(noise()));
    const Bytes whole = bytes_of(image);
    for (const std::size_t size : {whole.size() / 2, whole.size() * 95 / 100, whole.size() - 1}) {
        write(image, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
        EXPECT_THAT(error_of(image), HasSubstr("cut short")) << size << " of " << whole.size();
        EXPECT_THROW(read_origin(image), Error);
    }
}

TEST_P(PhoneFormatTest, SurvivesRandomDamage) {
    std::mt19937 random(20240611);
    const fs::path image = converted(GetParam().lossless, encode_png(noise()));
    const Bytes whole = bytes_of(image);
    for (int round = 0; round < 500; ++round) {
        Bytes damaged = whole;
        // Every other round damages only the first 400 bytes. These bytes contain the headers,
        // where damage has the largest effect.
        const std::size_t reach = round % 2 == 0 ? whole.size() : std::size_t{400};
        for (std::uint32_t flips = 1 + random() % 8; flips > 0; --flips)
            damaged[random() % reach] = static_cast<std::uint8_t>(random());
        write(image, damaged);
        try {
            const GreyImage read = read_image(image);
            ASSERT_EQ(read.pixels.size(), static_cast<std::size_t>(read.width_px) *
                                              static_cast<std::size_t>(read.height_px));
            static_cast<void>(read_origin(image));
        } catch (const Error& error) {
            ASSERT_THAT(error.what(), testing::StartsWith("cannot read "));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(of, PhoneFormatTest, testing::ValuesIn(kPhoneFormats),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace dotpose::test

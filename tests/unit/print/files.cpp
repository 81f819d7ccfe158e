#include "files.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <png.h>
#include <tiffio.h>

#include "system/files.hpp"

namespace dotpose::print_test {
namespace fs = std::filesystem;

TemporaryDirectory::TemporaryDirectory() {
    path_ = system::create_temporary_folder();
}

TemporaryDirectory::~TemporaryDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryDirectory::names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path_)) {
        names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    return names;
}

std::string read_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_file(const fs::path& path, const std::string& content) {
    std::ofstream stream(path, std::ios::binary);
    stream << content;
}

int Bitmap::count_ink() const {
    return static_cast<int>(std::ranges::count(ink, 1));
}

Bitmap read_png(const fs::path& path) {
    std::FILE* file = system::open_file(path, "rb");
    if (file == nullptr) throw std::runtime_error("cannot read " + path.string());
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    Bitmap bitmap;
    bitmap.width_px = static_cast<int>(png_get_image_width(png, info));
    bitmap.height_px = static_cast<int>(png_get_image_height(png, info));
    bitmap.bits_per_pixel = png_get_bit_depth(png, info);
    bitmap.x_dpi = png_get_x_pixels_per_meter(png, info) * 0.0254;
    bitmap.y_dpi = png_get_y_pixels_per_meter(png, info) * 0.0254;
    png_set_expand(png);  // expands to one byte per pixel, 0 or 255
    std::vector<png_byte> row(static_cast<std::size_t>(bitmap.width_px));
    for (int v = 0; v < bitmap.height_px; ++v) {
        png_read_row(png, row.data(), nullptr);
        for (const png_byte grey : row)
            bitmap.ink.push_back(grey == 0 ? 1 : 0);
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return bitmap;
}

Bitmap read_tiff(const fs::path& path) {
    TIFF* tiff = TIFFOpen(path.string().c_str(), "r");
    if (tiff == nullptr) throw std::runtime_error("cannot read " + path.string());
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint16_t bits = 0;
    std::uint16_t unit = 0;
    float x_dpi = 0;
    float y_dpi = 0;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetField(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetField(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
    TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &x_dpi);
    TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &y_dpi);
    // libtiff converts the samples to RGBA, so the test does not depend on which value is black in
    // the file. libtiff returns the rows from bottom to top.
    std::vector<std::uint32_t> pixels(std::size_t{width} * height);
    const bool read = TIFFReadRGBAImage(tiff, width, height, pixels.data(), 1) == 1;
    TIFFClose(tiff);
    if (!read || unit != RESUNIT_INCH) throw std::runtime_error("bad TIFF " + path.string());
    Bitmap bitmap{
        static_cast<int>(width), static_cast<int>(height), bits, double{x_dpi}, double{y_dpi}, {}};
    for (std::uint32_t v = height; v-- > 0;) {
        for (std::uint32_t u = 0; u < width; ++u) {
            const std::uint32_t pixel = pixels[std::size_t{v} * width + u];
            bitmap.ink.push_back(TIFFGetR(pixel) == 0 ? 1 : 0);
        }
    }
    return bitmap;
}

}  // namespace dotpose::print_test

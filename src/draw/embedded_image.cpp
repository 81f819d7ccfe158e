#include "draw/embedded_image.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <png.h>

#include "dotpose/files/error.hpp"

namespace dotpose::draw {
namespace {

/// Encodes an image as PNG with the simplified interface of libpng, which returns errors instead of
/// leaving by longjmp.
std::vector<std::uint8_t> encode_png(ImageView image) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width_px);
    png.height = static_cast<png_uint_32>(image.height_px);
    png.format = PNG_FORMAT_GRAY;
    png_alloc_size_t size_bytes = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::vector<std::uint8_t> bytes(size_bytes);
    const auto stride_bytes = static_cast<png_int_32>(image.stride_bytes);
    if (png_image_write_to_memory(&png, bytes.data(), &size_bytes, 0, image.pixels, stride_bytes,
                                  nullptr) == 0) {
        throw Error(std::string("cannot embed the image: ") + png.message);
    }
    bytes.resize(size_bytes);
    return bytes;
}

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr const char* kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t n) {
            return i + n < bytes.size() ? std::uint32_t{bytes[i + n]} : 0U;
        };
        const std::uint32_t group = byte(0) << 16 | byte(1) << 8 | byte(2);
        text += kDigits[group >> 18];
        text += kDigits[(group >> 12) & 63];
        text += i + 1 < bytes.size() ? kDigits[(group >> 6) & 63] : '=';
        text += i + 2 < bytes.size() ? kDigits[group & 63] : '=';
    }
    return text;
}

}  // namespace

std::string data_uri(ImageView image) {
    if (image.pixels == nullptr || image.width_px <= 0 || image.height_px <= 0) return {};
    return "data:image/png;base64," + base64(encode_png(image));
}

}  // namespace dotpose::draw

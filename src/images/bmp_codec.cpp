// Reads uncompressed BMP files with OS/2 headers or Windows headers (versions 3 to 5). A pixel has
// either 1, 4 or 8 bits, which are an index into a palette, or 16, 24 or 32 bits, which contain the
// colour. Microsoft documents the layout under BITMAPV5HEADER.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "images/image_format.hpp"
#include "images/samples.hpp"

namespace dotpose::images {
namespace {

constexpr std::size_t kFileHeader = 14;
constexpr std::size_t kOldHeader = 12;  // header size for OS/2 and Windows 2

/// Offsets of the header fields from the start of the file.
enum Offset : std::size_t {
    pixels_offset = 10,
    header_size = 14,
    old_width = 18,
    old_height = 20,
    old_bits = 24,
    width = 18,
    height = 22,
    bits = 28,
    compression = 30,
    x_per_metre = 38,
    y_per_metre = 42,
    palette_size = 46,
    masks = 54,  ///< bit masks of red, green, blue and opacity
};

enum Compression : std::uint32_t { none = 0, bit_fields = 3, bit_fields_with_opacity = 6 };

struct BmpHeader {
    std::int64_t width_px;
    std::int64_t height_px;
    bool is_top_down;
    std::size_t bits_per_pixel;
    std::size_t pixels_at;
    std::size_t row_bytes;
    std::size_t palette_at;
    std::size_t palette_count;
    std::size_t palette_entry_bytes;
    /// Bit masks of red, green, blue and opacity in a 16-bit or 32-bit pixel. The mask of a missing
    /// component is 0.
    std::array<std::uint32_t, 4> masks;
};

/// Reads an unsigned little-endian integer. `bytes` must be long enough.
std::uint32_t integer(Bytes bytes, std::size_t offset, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = size; i > 0; --i)
        value = value << 8 | bytes[offset + i - 1];
    return value;
}

[[noreturn]] void fail_short() {
    throw Error("the BMP image is cut short");
}
[[noreturn]] void fail(const char* reason) {
    throw Error(std::string("the BMP image is damaged or of an unknown kind (") + reason + ")");
}

std::uint32_t number(Bytes file, std::size_t offset, std::size_t size) {
    if (file.size() < offset + size) fail_short();
    return integer(file, offset, size);
}
std::int64_t signed_number(Bytes file, std::size_t offset) {
    return static_cast<std::int32_t>(number(file, offset, 4));
}

std::array<std::uint32_t, 4> masks_of(Bytes file, std::size_t bits_per_pixel, std::uint32_t kind) {
    if (kind == Compression::none) {
        if (bits_per_pixel == 16) return {0x7C00, 0x03E0, 0x001F, 0};
        return {0xFF0000, 0x00FF00, 0x0000FF, 0};
    }
    constexpr std::size_t kHeaderWithOpacity = 56;
    const bool has_opacity = kind == bit_fields_with_opacity ||
                             number(file, Offset::header_size, 4) >= kHeaderWithOpacity;
    return {number(file, Offset::masks, 4), number(file, Offset::masks + 4, 4),
            number(file, Offset::masks + 8, 4),
            has_opacity ? number(file, Offset::masks + 12, 4) : 0};
}

BmpHeader read_header(Bytes file) {
    BmpHeader header{};
    const std::size_t size = number(file, Offset::header_size, 4);
    const bool is_old = size == kOldHeader;
    if (!is_old && size < 16) fail("its header is too small");
    header.width_px = is_old ? number(file, Offset::old_width, 2) : signed_number(file, width);
    header.height_px = is_old ? number(file, Offset::old_height, 2) : signed_number(file, height);
    header.is_top_down = header.height_px < 0;
    header.height_px = std::abs(header.height_px);
    if (header.width_px <= 0 || header.height_px == 0) fail("a side has no pixels");
    header.bits_per_pixel = number(file, is_old ? Offset::old_bits : Offset::bits, 2);
    const std::uint32_t kind = is_old || size < 20 ? 0 : number(file, Offset::compression, 4);
    const bool has_fields = kind == bit_fields || kind == bit_fields_with_opacity;
    switch (header.bits_per_pixel) {
        case 1:
        case 4:
        case 8:
        case 24:
            if (kind != Compression::none) fail("compressed pixels are not supported");
            break;
        case 16:
        case 32:
            if (kind != Compression::none && !has_fields)
                fail("compressed pixels are not supported");
            header.masks = masks_of(file, header.bits_per_pixel, kind);
            break;
        default:
            fail("its number of bits per pixel");
    }
    header.pixels_at = number(file, Offset::pixels_offset, 4);
    header.row_bytes =
        (static_cast<std::size_t>(header.width_px) * header.bits_per_pixel + 31) / 32 * 4;
    header.palette_at = kFileHeader + size;
    header.palette_entry_bytes = is_old ? 3 : 4;
    const std::size_t stated = is_old || size < 36 ? 0 : number(file, Offset::palette_size, 4);
    const std::size_t max_count =
        header.bits_per_pixel <= 8 ? std::size_t{1} << header.bits_per_pixel : 0;
    header.palette_count = stated == 0 ? max_count : std::min(stated, max_count);
    return header;
}

/// Returns the bits selected by `mask` as a level from 0 to 255.
std::uint8_t level_of(std::uint32_t pixel, std::uint32_t mask) {
    if (mask == 0) return 0;
    const std::uint64_t full = mask >> std::countr_zero(mask);
    const std::uint64_t value = (pixel & mask) >> std::countr_zero(mask);
    return static_cast<std::uint8_t>((value * 255 + full / 2) / full);
}

using Colour = std::array<std::uint8_t, 4>;  // red, green, blue, opacity

class Pixels {
  public:
    Pixels(Bytes file, const BmpHeader& header) : header_(header) {
        for (std::size_t i = 0; i < header.palette_count; ++i) {
            const std::size_t at = header.palette_at + i * header.palette_entry_bytes;
            if (file.size() < at + 3) fail_short();
            palette_[i] = {file[at + 2], file[at + 1], file[at], 255};
        }
    }

    Colour at(Bytes row, std::size_t u) const {
        const std::size_t bits_per_pixel = header_.bits_per_pixel;
        if (bits_per_pixel <= 8) {
            const std::size_t bit = u * bits_per_pixel;
            const std::size_t shift = 8 - bits_per_pixel - bit % 8;
            return palette_[(row[bit / 8] >> shift) & ((1U << bits_per_pixel) - 1)];
        }
        const std::size_t bytes = bits_per_pixel / 8;
        const std::size_t offset = u * bytes;
        if (bytes == 3) return {row[offset + 2], row[offset + 1], row[offset], 255};
        const std::uint32_t pixel = integer(row, offset, bytes);
        const auto& masks = header_.masks;
        return {level_of(pixel, masks[0]), level_of(pixel, masks[1]), level_of(pixel, masks[2]),
                masks[3] == 0 ? std::uint8_t{255} : level_of(pixel, masks[3])};
    }

  private:
    BmpHeader header_;
    std::array<Colour, 256> palette_{};  // missing entries are black
};

}  // namespace

GreyImage decode_bmp(const ImageInput& input, std::string&) {
    const Bytes file = input.file;
    const BmpHeader header = read_header(file);
    require_size(static_cast<std::uint64_t>(header.width_px),
                 static_cast<std::uint64_t>(header.height_px), input.max_pixels);
    const auto height = static_cast<std::size_t>(header.height_px);
    const auto width = static_cast<std::size_t>(header.width_px);
    const Pixels pixels(file, header);
    if (file.size() < header.pixels_at ||
        (file.size() - header.pixels_at) / header.row_bytes < height)
        fail_short();
    Samples<std::uint8_t> samples{static_cast<int>(width), static_cast<int>(height), 4, {}};
    samples.values.reserve(4 * width * height);
    for (std::size_t v = 0; v < height; ++v) {
        const std::size_t stored = header.is_top_down ? v : height - 1 - v;
        const Bytes row =
            file.subspan(header.pixels_at + stored * header.row_bytes, header.row_bytes);
        for (std::size_t u = 0; u < width; ++u) {
            const Colour colour = pixels.at(row, u);
            samples.values.insert(samples.values.end(), colour.begin(), colour.end());
        }
    }
    return to_grey(std::move(samples));
}

ImageOrigin bmp_origin(const ImageInput& input) {
    const Bytes file = input.file;
    if (number(file, Offset::header_size, 4) < 40) return {};
    return {false, resolution_from(static_cast<double>(signed_number(file, Offset::x_per_metre)),
                                   static_cast<double>(signed_number(file, Offset::y_per_metre)),
                                   kMetresPerInch)};
}

}  // namespace dotpose::images

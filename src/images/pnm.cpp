// Reads PBM, PGM and PPM files in their text and binary variants (P1 to P6 in netpbm). Writes PGM
// files.
#include <algorithm>
#include <cstddef>
#include <string>

#include "dotpose/files/error.hpp"
#include "dotpose/tools/image_file.hpp"
#include "images/image_format.hpp"
#include "images/samples.hpp"

namespace dotpose::images {
namespace {

constexpr std::uint32_t kMaxLevel = 65'535;

[[noreturn]] void fail_damaged(const std::string& reason) {
    throw Error("the PNM image is damaged (" + reason + ")");
}

bool is_digit(char character) {
    return character >= '0' && character <= '9';
}
bool is_space(char character) {
    return character == ' ' || (character >= '\t' && character <= '\r');
}

class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    std::size_t bytes_left() const { return rest_.size(); }

    std::uint8_t byte() {
        if (rest_.empty()) throw Error("the PNM image is cut short");
        const std::uint8_t first = rest_.front();
        rest_ = rest_.subspan(1);
        return first;
    }

    /// Skips white space and comments, and returns the next character.
    char symbol() {
        char character = text();
        while (is_space(character))
            character = text();
        return character;
    }

    /// Reads a decimal number and the white space after it. The white space is required, because a
    /// number at the end of a truncated file may lack digits.
    std::uint32_t number() {
        std::uint32_t value = 0;
        char character = symbol();
        if (!is_digit(character)) fail_damaged("a number is expected");
        for (; is_digit(character); character = text()) {
            constexpr std::uint32_t kLimit = 100'000'000;
            if (value >= kLimit) fail_damaged("a number is too large");
            value = 10 * value + static_cast<std::uint32_t>(character - '0');
        }
        if (!is_space(character)) fail_damaged("a number is expected");
        ended_by_return_ = character == '\r';
        return value;
    }

    /// Skips the line feed at the end of the header if the header ends with a carriage return and a
    /// line feed. If at most `pixel_bytes` bytes are left, the next byte belongs to the pixels and
    /// is not skipped.
    void finish_line_break(std::size_t pixel_bytes) {
        if (ended_by_return_ && rest_.size() > pixel_bytes && rest_.front() == '\n') byte();
    }

  private:
    /// Reads one character. For a comment, returns the line break at its end.
    char text() {
        char character = static_cast<char>(byte());
        if (character != '#') return character;
        while (character != '\n' && character != '\r')
            character = static_cast<char>(byte());
        return character;
    }

    std::span<const std::uint8_t> rest_;
    bool ended_by_return_ = false;  ///< true if a carriage return followed the last number
};

struct Header {
    bool is_text = false;
    bool is_bitmap = false;
    std::size_t channels = 1;
    std::size_t width_px = 0;
    std::size_t height_px = 0;
    std::uint32_t max_level = 1;
};

Header read_header(Reader& reader, int max_pixels) {
    Header header;
    reader.byte();
    const int kind = reader.byte() - '0';
    header.is_text = kind <= 3;
    header.is_bitmap = kind == 1 || kind == 4;
    header.channels = kind == 3 || kind == 6 ? 3 : 1;
    header.width_px = reader.number();
    header.height_px = reader.number();
    if (!header.is_bitmap) header.max_level = reader.number();
    if (header.width_px == 0 || header.height_px == 0) fail_damaged("it has no pixels");
    if (header.max_level == 0 || header.max_level > kMaxLevel) {
        fail_damaged("its largest level is not in 1 to 65535");
    }
    require_size(header.width_px, header.height_px, max_pixels);
    return header;
}

/// Returns the minimum size of the pixel data in bytes. The image is allocated only if at least
/// this much data follows the header.
std::size_t min_bytes(const Header& header) {
    const std::size_t samples = header.width_px * header.height_px * header.channels;
    if (header.is_bitmap) {
        return header.is_text ? samples : (header.width_px + 7) / 8 * header.height_px;
    }
    const bool has_two_bytes = header.is_text || header.max_level > 255;
    return has_two_bytes ? 2 * samples : samples;
}

void read_bitmap(Reader& reader, const Header& header, GreyImage& image) {
    std::size_t u = 0;
    unsigned bits = 0;
    for (std::uint8_t& pixel : image.pixels) {
        if (header.is_text) {
            const char symbol = reader.symbol();
            if (symbol != '0' && symbol != '1') fail_damaged("0 or 1 is expected");
            bits = symbol == '1' ? 0x80 : 0;
        } else {
            bits = u % 8 == 0 ? reader.byte() : bits << 1;
        }
        pixel = (bits & 0x80) != 0 ? 0 : 255;
        u = u + 1 == header.width_px ? 0 : u + 1;
    }
}

std::uint32_t read_level(Reader& reader, const Header& header) {
    std::uint32_t level = 0;
    if (header.is_text) {
        level = reader.number();
    } else {
        level = reader.byte();
        if (header.max_level > 255) level = level << 8 | reader.byte();
    }
    if (level > header.max_level) fail_damaged("a level is above the largest one");
    return level;
}

/// Returns the white level. `reader` is passed by value, because the samples are read again after
/// the search for the largest level.
std::uint32_t white_of(Reader reader, const Header& header) {
    if (header.max_level < kMaxLevel) return header.max_level;
    std::uint32_t largest = 0;
    const std::size_t samples = header.width_px * header.height_px * header.channels;
    for (std::size_t i = 0; i < samples; ++i)
        largest = std::max(largest, read_level(reader, header));
    return white_level(largest);
}

void read_levels(Reader& reader, const Header& header, GreyImage& image) {
    constexpr std::uint64_t kLumaScale = 1000;  // sum of the Rec. 601 weights
    const std::uint64_t scale = kLumaScale * white_of(reader, header);
    for (std::uint8_t& pixel : image.pixels) {
        const std::uint64_t first = read_level(reader, header);
        std::uint64_t luma = kLumaScale * first;
        if (header.channels == 3) {
            const std::uint64_t green = read_level(reader, header);
            const std::uint64_t blue = read_level(reader, header);
            luma = 299 * first + 587 * green + 114 * blue;
        }
        pixel = static_cast<std::uint8_t>((255 * luma + scale / 2) / scale);
    }
}

}  // namespace

GreyImage decode_pnm(const ImageInput& input, std::string&) {
    Reader reader(input.file);
    const Header header = read_header(reader, input.max_pixels);
    if (reader.bytes_left() < min_bytes(header)) throw Error("the PNM image is cut short");
    if (!header.is_text) reader.finish_line_break(min_bytes(header));
    GreyImage image;
    image.width_px = static_cast<int>(header.width_px);
    image.height_px = static_cast<int>(header.height_px);
    image.pixels.resize(header.width_px * header.height_px);
    if (header.is_bitmap) {
        read_bitmap(reader, header, image);
    } else {
        read_levels(reader, header, image);
    }
    return image;
}

std::vector<std::uint8_t> encode_pgm(ImageView image) {
    const std::string header =
        "P5\n" + std::to_string(image.width_px) + " " + std::to_string(image.height_px) + "\n255\n";
    std::vector<std::uint8_t> bytes(header.begin(), header.end());
    for (int v = 0; v < image.height_px; ++v)
        bytes.insert(bytes.end(), image.row(v), image.row(v) + image.width_px);
    return bytes;
}

}  // namespace dotpose::images

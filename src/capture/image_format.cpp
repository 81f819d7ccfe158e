#include "capture/image_format.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <set>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "capture/bytes.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {
namespace {

bool png_is_cut_short(Bytes bytes) {
    constexpr std::size_t kSignature = 8;
    constexpr std::size_t kChunkFrame = 12;         // length, type, checksum
    constexpr std::uint64_t kEndType = 0x49454E44;  // "IEND"
    std::size_t offset = kSignature;
    while (bytes.size() - offset >= kChunkFrame) {
        const std::uint64_t length = integer(bytes, offset, 4, true);
        if (length > bytes.size() - offset - kChunkFrame) return true;
        if (integer(bytes, offset + 4, 4, true) == kEndType) return false;
        offset += kChunkFrame + length;
    }
    return true;
}

bool jpeg_is_cut_short(Bytes bytes) {
    constexpr std::array<std::uint8_t, 2> kEndOfImage{0xFF, 0xD9};
    // Some cameras append padding, so the marker is not always in the last two bytes.
    return std::search(bytes.rbegin(), bytes.rend(), kEndOfImage.rbegin(), kEndOfImage.rend()) ==
           bytes.rend();
}

bool bmp_is_cut_short(Bytes bytes) {
    constexpr std::size_t kFileHeader = 14;
    return bytes.size() < kFileHeader || integer(bytes, 2, 4, false) > bytes.size();
}

/// The directories of a TIFF or BigTIFF file, one for each page. The two kinds of file differ in
/// the widths of their numbers.
class TiffDirectories {
  public:
    explicit TiffDirectories(Bytes bytes)
        : bytes_(bytes), big_endian_(bytes[0] == 'M'), is_big_(bytes[big_endian_ ? 3 : 2] == 43) {
        const std::size_t start = is_big_ ? 8 : 4;
        std::set<std::uint64_t> offsets = {0};
        std::uint64_t offset = holds(start, word()) ? number(start, word()) : 0;
        // A damaged file may have a loop of directories.
        while (offsets.insert(offset).second) {
            const auto directory = directory_at(offset);
            if (!directory) break;
            pages_.push_back(*directory);
            offset = number(directory->first + directory->count * entry_size(), word());
        }
    }

    int count() const { return static_cast<int>(pages_.size()); }

    bool is_cut_short(int page) const {
        if (page > count()) return true;
        const Directory& directory = pages_[static_cast<std::size_t>(page - 1)];
        Values offsets;
        Values sizes;
        for (std::uint64_t i = 0; i < directory.count; ++i) {
            const std::uint64_t entry = directory.first + i * entry_size();
            const Values values = values_of(entry);
            if (values.count > bytes_.size() || !holds(values.offset, values.count * values.size)) {
                return true;
            }
            const std::uint64_t tag = number(entry, 2);
            if (tag == strip_offsets || tag == tile_offsets) offsets = values;
            if (tag == strip_sizes || tag == tile_sizes) sizes = values;
        }
        return !holds_pixels(offsets, sizes);
    }

  private:
    /// The entries of one directory.
    struct Directory {
        std::uint64_t first = 0;  ///< offset of the first entry
        std::uint64_t count = 0;
    };
    /// An array of integers in the file.
    struct Values {
        std::uint64_t offset = 0;
        std::uint64_t count = 0;
        std::uint64_t size = 0;  ///< bytes per value
    };
    enum Tag : std::uint64_t {
        strip_offsets = 273,
        strip_sizes = 279,
        tile_offsets = 324,
        tile_sizes = 325,
    };

    std::uint64_t word() const { return is_big_ ? 8 : 4; }
    std::uint64_t entry_size() const { return 4 + 2 * word(); }
    bool holds(std::uint64_t offset, std::uint64_t size) const {
        return offset <= bytes_.size() && size <= bytes_.size() - offset;
    }
    std::uint64_t number(std::uint64_t offset, std::uint64_t size) const {
        return integer(bytes_, offset, size, big_endian_);
    }

    /// Returns the directory at an offset; none if it reaches beyond the end of the file.
    std::optional<Directory> directory_at(std::uint64_t offset) const {
        const std::size_t count_size = is_big_ ? 8 : 2;
        if (!holds(offset, count_size)) return std::nullopt;
        const Directory directory{offset + count_size, number(offset, count_size)};
        // The entries are followed by the offset of the next directory.
        const bool is_whole = directory.count <= bytes_.size() / entry_size() &&
                              holds(directory.first, directory.count * entry_size() + word());
        return is_whole ? std::optional(directory) : std::nullopt;
    }

    Values values_of(std::uint64_t entry) const {
        // Bytes per value of the types 0 to 18. Unknown types are ignored, as the decoder does.
        constexpr std::array<std::uint8_t, 19> kTypeSizes{0, 1, 1, 2, 4, 8, 1, 1, 2, 4,
                                                          8, 4, 8, 4, 0, 0, 8, 8, 8};
        const std::uint64_t type = number(entry + 2, 2);
        Values values;
        values.size = type < kTypeSizes.size() ? kTypeSizes[type] : 0;
        values.count = number(entry + 4, word());
        const std::uint64_t place = entry + 4 + word();
        const bool is_inline = values.size == 0 || values.count <= word() / values.size;
        values.offset = is_inline ? place : number(place, word());
        if (values.size == 0) values.count = 0;
        return values;
    }

    bool holds_pixels(const Values& offsets, const Values& sizes) const {
        const std::uint64_t count = std::min(offsets.count, sizes.count);
        for (std::uint64_t i = 0; i < count; ++i) {
            const std::uint64_t offset = number(offsets.offset + i * offsets.size, offsets.size);
            const std::uint64_t size = number(sizes.offset + i * sizes.size, sizes.size);
            if (!holds(offset, size)) return false;
        }
        return true;
    }

    Bytes bytes_;
    bool big_endian_;
    bool is_big_;
    std::vector<Directory> pages_;
};

}  // namespace

void require_size(std::uint64_t width_px, std::uint64_t height_px, int max_pixels) {
    if (width_px > kMaxImageSide_px || height_px > kMaxImageSide_px) throw Error(kTooLarge);
    if (width_px * height_px <= static_cast<std::uint64_t>(std::min(max_pixels, kMaxImagePixels))) {
        return;
    }
    throw ImageTooLarge(
        fmt::format("the image is too large: {} x {} px; at most {} million px are read", width_px,
                    height_px, max_pixels / 1'000'000),
        static_cast<int>(width_px), static_cast<int>(height_px));
}

std::optional<ImageFormat> sniff(std::span<const std::uint8_t> bytes) {
    using namespace std::string_view_literals;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x89PNG\r\n\x1A\n"sv)) return ImageFormat::png;
    if (text.starts_with("\xFF\xD8\xFF"sv)) return ImageFormat::jpeg;
    for (const std::string_view magic : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv}) {
        if (text.starts_with(magic)) return ImageFormat::tiff;
    }
    if (text.starts_with("BM"sv)) return ImageFormat::bmp;
    if (text.size() >= 3 && text[0] == 'P' && text[1] >= '1' && text[1] <= '6' &&
        " \t\n\v\f\r#"sv.find(text[2]) != std::string_view::npos) {
        return ImageFormat::pnm;
    }
    return std::nullopt;
}

std::uint32_t white_level(std::uint32_t largest) {
    constexpr int kMostBits = 12;
    const int bits = std::max(static_cast<int>(std::bit_width(largest)), 8);
    return (1U << (bits > kMostBits ? 16 : bits)) - 1;
}

std::optional<OtherFormat> sniff_other(std::span<const std::uint8_t> bytes) {
    using namespace std::string_view_literals;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto has_at = [text](std::size_t offset, std::string_view magic) {
        return text.size() >= offset && text.substr(offset).starts_with(magic);
    };
    constexpr std::array<std::string_view, 8> kHeif = {"heic", "heix", "heim", "heis",
                                                       "hevc", "mif1", "msf1", "avif"};
    const auto has_brand = [&](std::string_view brand) { return has_at(8, brand); };
    if (has_at(4, "ftyp") && std::ranges::any_of(kHeif, has_brand)) {
        return OtherFormat{"a photo in HEIC or AVIF format", "heif-convert PHOTO.heic PHOTO.jpg"};
    }
    if (has_at(0, "RIFF") && has_at(8, "WEBP")) {
        return OtherFormat{"a WebP image", "dwebp IMAGE.webp -o IMAGE.png"};
    }
    if (has_at(0, "GIF8")) return OtherFormat{"a GIF image", "gm convert IMAGE.gif IMAGE.png"};
    if (has_at(0, "\xFF\x0A"sv) || has_at(4, "JXL ")) {
        return OtherFormat{"a JPEG XL image", "djxl IMAGE.jxl IMAGE.png"};
    }
    if (has_at(4, "jP  ")) {
        return OtherFormat{"a JPEG 2000 image", "opj_decompress -i IMAGE.jp2 -o IMAGE.png"};
    }
    return std::nullopt;
}

const char* name(ImageFormat format) {
    switch (format) {
        case ImageFormat::pnm:
            return "PNM";
        case ImageFormat::png:
            return "PNG";
        case ImageFormat::jpeg:
            return "JPEG";
        case ImageFormat::bmp:
            return "BMP";
        case ImageFormat::tiff:
            return "TIFF";
    }
    return "";
}

int pages_of(ImageFormat format, std::span<const std::uint8_t> bytes) {
    return format == ImageFormat::tiff ? std::max(TiffDirectories(bytes).count(), 1) : 1;
}

bool is_cut_short(ImageFormat format, std::span<const std::uint8_t> bytes, int page) {
    switch (format) {
        case ImageFormat::pnm:
            return false;
        case ImageFormat::png:
            return png_is_cut_short(bytes);
        case ImageFormat::jpeg:
            return jpeg_is_cut_short(bytes);
        case ImageFormat::bmp:
            return bmp_is_cut_short(bytes);
        case ImageFormat::tiff:
            return TiffDirectories(bytes).is_cut_short(page);
    }
    return false;
}

bool is_too_large(ImageFormat format, std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kWidthOffset = 16;
    constexpr std::size_t kHeightOffset = 20;
    if (format != ImageFormat::png || bytes.size() < kHeightOffset + 4) return false;
    return integer(bytes, kWidthOffset, 4, true) > kMaxImageSide_px ||
           integer(bytes, kHeightOffset, 4, true) > kMaxImageSide_px;
}

}  // namespace dotpose::capture

// Finds the EXIF data of JPEG, PNG and TIFF files, and the entries that cameras write. The layout
// is specified by TIFF 6.0, the tags by the Exif standard (CIPA DC-008).
#include "capture/exif.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace dotpose::capture {
namespace {

bool holds(Bytes bytes, std::size_t offset, std::size_t size) {
    return offset <= bytes.size() && size <= bytes.size() - offset;
}

bool holds_text(Bytes bytes, std::size_t offset, std::string_view text) {
    return holds(bytes, offset, text.size()) &&
           std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

/// Returns the EXIF data of a JPEG: the contents of its APP1 segment named Exif.
Bytes exif_of_jpeg(Bytes file) {
    using namespace std::string_view_literals;
    constexpr std::string_view kName = "Exif\0\0"sv;
    constexpr std::uint8_t kApp1 = 0xE1;
    constexpr std::uint8_t kStartOfScan = 0xDA;
    constexpr std::size_t kMarker = 2;
    // Each segment has a marker (FF and a type) and a length that includes the length field itself.
    std::size_t offset = kMarker;
    while (holds(file, offset, 2 * kMarker) && file[offset] == 0xFF) {
        const std::uint8_t type = file[offset + 1];
        if (type == kStartOfScan) break;
        if (type == 0xFF) {  // padding
            ++offset;
            continue;
        }
        const auto length = static_cast<std::size_t>(integer(file, offset + kMarker, 2, true));
        if (!holds(file, offset + kMarker, length)) break;
        if (type == kApp1 && length >= kMarker + kName.size() &&
            holds_text(file, offset + 2 * kMarker, kName)) {
            const std::size_t before = kMarker + kName.size();
            return file.subspan(offset + kMarker + before, length - before);
        }
        offset += kMarker + std::max(length, kMarker);
    }
    return {};
}

/// Returns the EXIF data of a PNG: the contents of its eXIf chunk.
Bytes exif_of_png(Bytes file) {
    constexpr std::size_t kSignature = 8;
    constexpr std::size_t kBefore = 8;       // length and type
    constexpr std::size_t kChunkFrame = 12;  // length, type and checksum
    std::size_t offset = kSignature;
    while (holds(file, offset, kChunkFrame)) {
        const auto length = static_cast<std::size_t>(integer(file, offset, 4, true));
        if (!holds(file, offset + kChunkFrame, length)) break;
        if (holds_text(file, offset + 4, "eXIf")) return file.subspan(offset + kBefore, length);
        offset += kChunkFrame + length;
    }
    return {};
}

/// The directories of EXIF data or of a TIFF file.
class Directories {
  public:
    explicit Directories(Bytes bytes) : bytes_(bytes) {}

    bool has_camera() const {
        constexpr std::size_t kHeader = 8;
        using namespace std::string_view_literals;
        const bool is_little = holds_text(bytes_, 0, "II*\0"sv);
        if (!holds(bytes_, 0, kHeader) || !(is_little || holds_text(bytes_, 0, "MM\0*"sv)))
            return false;
        const auto exif = entry(number(4, 4), kExifDirectory);
        if (!exif) return false;
        constexpr std::array<std::uint32_t, 4> kCameraTags{0x829A,   // exposure time
                                                           0x829D,   // f-number
                                                           0x8827,   // sensitivity
                                                           0x920A};  // focal length
        return std::ranges::any_of(
            kCameraTags, [&](std::uint32_t tag) { return entry(*exif, tag).has_value(); });
    }

  private:
    static constexpr std::uint32_t kExifDirectory = 0x8769;

    std::uint32_t number(std::size_t offset, std::size_t size) const {
        return static_cast<std::uint32_t>(integer(bytes_, offset, size, bytes_[0] == 'M'));
    }

    /// Returns the value of an entry, or the offset of its values. `directory` is the offset of the
    /// directory.
    std::optional<std::uint32_t> entry(std::uint32_t directory, std::uint32_t tag) const {
        constexpr std::size_t kCount = 2;
        constexpr std::size_t kEntry = 12;  // tag, type, number of values, value
        constexpr std::size_t kValue = 8;
        if (!holds(bytes_, directory, kCount)) return std::nullopt;
        const std::size_t first = directory + kCount;
        const std::size_t entries = number(directory, kCount);
        for (std::size_t i = 0; i < entries && holds(bytes_, first + i * kEntry, kEntry); ++i) {
            const std::size_t offset = first + i * kEntry;
            if (number(offset, 2) == tag) return number(offset + kValue, 4);
        }
        return std::nullopt;
    }

    Bytes bytes_;
};

}  // namespace

bool is_from_camera(ImageFormat format, Bytes file) {
    switch (format) {
        case ImageFormat::jpeg:
            return Directories(exif_of_jpeg(file)).has_camera();
        case ImageFormat::png:
            return Directories(exif_of_png(file)).has_camera();
        case ImageFormat::tiff:
            return Directories(file).has_camera();
        case ImageFormat::pnm:
        case ImageFormat::bmp:
            return false;
    }
    return false;
}

}  // namespace dotpose::capture

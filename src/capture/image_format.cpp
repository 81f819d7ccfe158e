#include "capture/image_format.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/core.h>

namespace dotpose::capture {

std::optional<Resolution> resolution_from(double x, double y, double units_per_inch) {
    if (!(x > 0 && y > 0)) return std::nullopt;
    return Resolution{x * units_per_inch, y * units_per_inch};
}

void require_size(std::uint64_t width_px, std::uint64_t height_px, int max_pixels) {
    if (width_px > kMaxImageSide_px || height_px > kMaxImageSide_px) {
        throw Error("the image is too large: at most 100,000 px per side and 2^28 px are read");
    }
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
    if (has_at(0, "GIF8")) return OtherFormat{"a GIF image", "ffmpeg -i IMAGE.gif IMAGE.png"};
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

}  // namespace dotpose::capture

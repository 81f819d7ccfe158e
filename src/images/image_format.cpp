#include "images/image_format.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace dotpose::images {
namespace {

using namespace std::string_view_literals;
using Head = std::string_view;

bool has_at(Head head, std::size_t offset, std::string_view magic) {
    return head.size() >= offset && head.substr(offset).starts_with(magic);
}

bool is_pnm(Head head) {
    return head.size() >= 3 && head[0] == 'P' && head[1] >= '1' && head[1] <= '6' &&
           " \t\n\v\f\r#"sv.find(head[2]) != std::string_view::npos;
}
bool is_tiff(Head head) {
    return head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv) ||
           head.starts_with("II+\0"sv) || head.starts_with("MM\0+"sv);
}
bool is_webp(Head head) {
    return head.starts_with("RIFF") && has_at(head, 8, "WEBP");
}
bool is_heif(Head head) {
    constexpr std::array kBrands = {"heic"sv, "heix"sv, "heim"sv, "heis"sv,
                                    "hevc"sv, "mif1"sv, "msf1"sv, "avif"sv};
    return has_at(head, 4, "ftyp") &&
           std::ranges::any_of(kBrands, [&](auto brand) { return has_at(head, 8, brand); });
}

constexpr ImageFormat kFormats[] = {
    {is_pnm, decode_pnm, [](const ImageInput&) { return ImageOrigin(); }},
    {[](Head head) { return head.starts_with("\x89PNG\r\n\x1A\n"); }, decode_png, png_origin},
    {[](Head head) { return head.starts_with("\xFF\xD8\xFF"); }, decode_jpeg, jpeg_origin},
    {[](Head head) { return head.starts_with("BM"); }, decode_bmp, bmp_origin},
    {is_tiff, decode_tiff, tiff_origin, tiff_pages},
#ifdef DOTPOSE_READS_WEBP
    {is_webp, decode_webp, webp_origin},
#endif
#ifdef DOTPOSE_READS_HEIF
    {is_heif, decode_heif, heif_origin},
#endif
};

constexpr OtherFormat kOtherFormats[] = {
    {is_heif, "a photo in HEIC or AVIF format", "heif-convert PHOTO.heic PHOTO.jpg"},
    {is_webp, "a WebP image", "dwebp IMAGE.webp -o IMAGE.png"},
    {[](Head head) { return head.starts_with("GIF8"); }, "a GIF image",
     "ffmpeg -i IMAGE.gif IMAGE.png"},
    {[](Head head) { return head.starts_with("\xFF\x0A") || has_at(head, 4, "JXL "); },
     "a JPEG XL image", "djxl IMAGE.jxl IMAGE.png"},
    {[](Head head) { return has_at(head, 4, "jP  "); }, "a JPEG 2000 image",
     "opj_decompress -i IMAGE.jp2 -o IMAGE.png"},
};

template <typename Formats>
auto find_format(const Formats& formats, Bytes bytes) -> decltype(std::begin(formats)) {
    const Head head(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto found =
        std::ranges::find_if(formats, [&](auto& each) { return each.matches(head); });
    return found == std::end(formats) ? nullptr : found;
}

}  // namespace

const ImageFormat* format_of(Bytes head) {
    return find_format(kFormats, head);
}

const OtherFormat* other_format_of(Bytes head) {
    return find_format(kOtherFormats, head);
}

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

}  // namespace dotpose::images

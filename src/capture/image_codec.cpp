#include "capture/image_codec.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include <magick/api.h>

#include "capture/pnm.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {
namespace {

struct InfoDeleter {
    void operator()(ImageInfo* info) const { DestroyImageInfo(info); }
};
struct ImageDeleter {
    void operator()(Image* image) const { DestroyImageList(image); }
};
struct BlobDeleter {
    void operator()(void* blob) const { MagickFree(blob); }
};
using InfoPointer = std::unique_ptr<ImageInfo, InfoDeleter>;
using ImagePointer = std::unique_ptr<Image, ImageDeleter>;

/// Collects the errors that GraphicsMagick reports.
class Report : public ExceptionInfo {
  public:
    Report() { GetExceptionInfo(this); }
    ~Report() { DestroyExceptionInfo(this); }
    Report(const Report&) = delete;
    Report& operator=(const Report&) = delete;

    /// Whether the call failed. For a damaged file that lacks pixels the library fills them up and
    /// reports only a warning.
    bool is_failure() const {
        return severity >= ErrorException || severity == CorruptImageWarning;
    }
    bool mentions(const char* text) const {
        return reason != nullptr && std::strstr(reason, text) != nullptr;
    }
};

/// Global state of GraphicsMagick, from its first use to the end of the program.
class Library {
  public:
    Library() {
        // The program handles signals, not the library.
        if (InitializeMagickEx(nullptr, MAGICK_OPT_NO_SIGNAL_HANDER, nullptr) == MagickFail) {
            throw Error("the image decoding library could not be started");
        }
        SetMagickResourceLimit(WidthResource, kMaxImageSide_px);
        SetMagickResourceLimit(HeightResource, kMaxImageSide_px);
        SetMagickResourceLimit(PixelsResource, kMaxImagePixels);
        // Frames are so small that threads would make decoding slower.
        SetMagickResourceLimit(ThreadsResource, 1);
        // The library must not move pixels to temporary files.
        SetMagickResourceLimit(DiskResource, 0);
        SetMagickResourceLimit(MapResource, 0);
    }
    ~Library() { DestroyMagick(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

void start_library() {
    static const Library kLibrary;
}

InfoPointer make_info(ImageFormat format, int page = 1) {
    InfoPointer info(CloneImageInfo(nullptr));
    // The format is set, so that the library does not guess among the many formats it knows.
    std::strncpy(info->magick, name(format), sizeof info->magick - 1);
    info->subimage = static_cast<unsigned long>(page - 1);
    info->subrange = 1;
    return info;
}

[[noreturn]] void fail(ImageFormat format, std::span<const std::uint8_t> bytes,
                       const Report& report) {
    const std::string kind = name(format);
    if (report.mentions("Memory allocation failed")) throw std::bad_alloc();
    if (report.severity == ResourceLimitError || report.mentions("exceeds resource limit") ||
        is_too_large(format, bytes)) {
        throw Error(kTooLarge);
    }
    const bool is_short = report.mentions("end-of-file") || report.mentions("Insufficient") ||
                          report.mentions("Premature end") || is_cut_short(format, bytes);
    if (is_short) throw Error("the " + kind + " image is cut short");
    const bool has_reason = report.reason != nullptr && *report.reason != '\0';
    throw Error("the " + kind + " image is damaged or of an unknown kind" +
                (has_reason ? " (" + std::string(report.reason) + ")" : ""));
}

/// Converts a row of 16-bit red, green, blue and opacity to grey, with a single rounding.
void convert_row(std::span<const std::uint16_t> rgba, std::uint8_t* grey) {
    constexpr std::uint64_t kFull = 65'535;
    constexpr std::uint64_t kLumaScale = 1000;  // sum of the Rec. 601 weights
    constexpr std::uint64_t kScale = kFull * kLumaScale * (kFull / 255);
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
        const std::uint64_t luma = 299ULL * rgba[i] + 587ULL * rgba[i + 1] + 114ULL * rgba[i + 2];
        const std::uint64_t opacity = rgba[i + 3];
        const std::uint64_t on_white = luma * opacity + kFull * kLumaScale * (kFull - opacity);
        *grey++ = static_cast<std::uint8_t>((on_white + kScale / 2) / kScale);
    }
}

/// Calls `use` with 16-bit red, green, blue and opacity of each row. Returns false if the library
/// fails.
template <typename Use>
bool for_each_row(const Image& image, Report& report, Use use) {
    std::vector<std::uint16_t> row(4 * image.columns);
    for (unsigned long v = 0; v < image.rows; ++v) {
        if (DispatchImage(&image, 0, static_cast<long>(v), image.columns, 1, "RGBA", ShortPixel,
                          row.data(), &report) == MagickFail) {
            return false;
        }
        use(v, row);
    }
    return true;
}

/// Returns the level of white: of an opaque image of 16 bits the largest of the bits in use.
std::uint32_t white_of(const Image& image, Report& report) {
    constexpr std::uint32_t kFull = 65'535;
    if (image.depth <= 8 || image.matte != MagickFalse) return kFull;
    std::uint32_t largest = 0;
    for_each_row(image, report, [&largest](unsigned long, std::span<const std::uint16_t> rgba) {
        for (std::size_t i = 0; i < rgba.size(); ++i) {
            if (i % 4 != 3) largest = std::max<std::uint32_t>(largest, rgba[i]);
        }
    });
    return white_level(largest);
}

GreyImage to_grey(const Image& image, Report& report) {
    GreyImage grey;
    grey.width_px = static_cast<int>(image.columns);
    grey.height_px = static_cast<int>(image.rows);
    grey.pixels.resize(image.columns * image.rows);
    const std::uint32_t white = white_of(image, report);
    const auto convert = [&](unsigned long v, std::span<std::uint16_t> rgba) {
        constexpr std::uint32_t kFull = 65'535;
        for (std::size_t i = 0; white < kFull && i < rgba.size(); ++i) {
            if (i % 4 != 3) rgba[i] = static_cast<std::uint16_t>(rgba[i] * kFull / white);
        }
        convert_row(rgba, grey.pixels.data() + v * image.columns);
    };
    return for_each_row(image, report, convert) ? grey : GreyImage();
}

/// Decodes an image; none if it is damaged.
ImagePointer decode(ImageFormat format, std::span<const std::uint8_t> bytes, int page,
                    Report& report) {
    const InfoPointer info = make_info(format, page);
    ImagePointer image(BlobToImage(info.get(), bytes.data(), bytes.size(), &report));
    if (report.is_failure()) image.reset();
    return image;
}

/// Returns a JPEG image with the marker that ends one. If pixels are missing before it, the decoder
/// reports that.
std::vector<std::uint8_t> with_end_marker(std::span<const std::uint8_t> bytes) {
    std::vector<std::uint8_t> ended(bytes.begin(), bytes.end());
    ended.insert(ended.end(), {0xFF, 0xD9});
    return ended;
}

/// Reads the header of an image without its pixels.
ImagePointer read_header(ImageFormat format, std::span<const std::uint8_t> bytes, int page) {
    Report report;
    const InfoPointer info = make_info(format, page);
    ImagePointer image(PingBlob(info.get(), bytes.data(), bytes.size(), &report));
    if (!image) fail(format, bytes, report);
    return image;
}

}  // namespace

GreyImage decode_image(ImageFormat format, std::span<const std::uint8_t> bytes, int max_pixels,
                       std::string& note, int page) {
    start_library();
    Report report;
    // The library leaves the pixels of missing TIFF strips unset and reports nothing.
    if (format == ImageFormat::tiff && is_cut_short(format, bytes, page)) {
        fail(format, bytes, report);
    }
    {
        const ImagePointer header = read_header(format, bytes, page);
        require_size(header->columns, header->rows, max_pixels);
    }
    ImagePointer image = decode(format, bytes, page, report);
    if (!image && format == ImageFormat::jpeg) {
        Report of_ended;
        image = decode(format, with_end_marker(bytes), page, of_ended);
        if (image) note = "the JPEG image lacks its end marker; its pixels are complete";
    }
    if (!image) fail(format, bytes, report);
    if (image->colorspace == CMYKColorspace) TransformColorspace(image.get(), RGBColorspace);
    GreyImage grey = to_grey(*image, report);
    if (grey.pixels.empty()) fail(format, bytes, report);
    return grey;
}

std::optional<Resolution> decode_resolution(ImageFormat format, std::span<const std::uint8_t> bytes,
                                            int page) {
    start_library();
    const ImagePointer image = read_header(format, bytes, page);
    const bool is_stated = image->x_resolution > 0 && image->y_resolution > 0;
    if (!is_stated || image->units == UndefinedResolution) return std::nullopt;
    const double per_inch = image->units == PixelsPerCentimeterResolution ? 2.54 : 1;
    return Resolution{per_inch * image->x_resolution, per_inch * image->y_resolution};
}

namespace {

constexpr unsigned long kJpegQuality = 95;

std::vector<std::uint8_t> encode(ImageFormat format, const GreyImage& image) {
    start_library();
    Report report;
    const auto width = static_cast<unsigned long>(image.width_px);
    const auto height = static_cast<unsigned long>(image.height_px);
    const ImagePointer magick(
        ConstituteImage(width, height, "I", CharPixel, image.pixels.data(), &report));
    std::size_t size = 0;
    std::unique_ptr<void, BlobDeleter> blob;
    if (magick) {
        const InfoPointer info = make_info(format);
        if (format == ImageFormat::jpeg) info->quality = kJpegQuality;
        std::strncpy(magick->magick, info->magick, sizeof magick->magick);
        blob.reset(ImageToBlob(info.get(), magick.get(), &size, &report));
    }
    if (!blob) {
        throw Error(std::string("the ") + name(format) + " encoder failed: " + report.reason);
    }
    const auto* first = static_cast<const std::uint8_t*>(blob.get());
    return {first, first + size};
}

}  // namespace

std::vector<std::uint8_t> encode_png(const GreyImage& image) {
    return encode(ImageFormat::png, image);
}

std::vector<std::uint8_t> encode(FrameFormat format, const GreyImage& image) {
    switch (format) {
        case FrameFormat::png:
            return encode(ImageFormat::png, image);
        case FrameFormat::jpeg:
            return encode(ImageFormat::jpeg, image);
        case FrameFormat::pgm:
            break;
    }
    return encode_pgm(image.view());
}

}  // namespace dotpose::capture

/// Reads images from files as 8-bit grey, and writes grey images.
///
/// Formats: PNM (PBM, PGM and PPM, text and binary), PNG, JPEG, BMP and TIFF. If dotpose was built
/// with libwebp and libheif, also WebP, HEIC and AVIF. The format is determined by the first bytes
/// of a file, not by its name. A truncated or damaged file causes an Error, even if part of the
/// picture could be decoded, because pixels that the decoder fills in are not measurements. A JPEG
/// that lacks only its end marker is accepted.
///
/// Every pixel is converted to one grey level, from 0 (black) to 255 (white). Colour is converted
/// to the luma 0.299 R + 0.587 G + 0.114 B (Rec. 601) of the stored values. Gamma and colour
/// profiles are ignored. Palettes are expanded, and CMYK is converted without a profile. Samples
/// with a maximum value other than 255, such as 16-bit samples, are scaled to 0..255 and rounded.
/// Opaque 16-bit images in which no value exceeds 4095 are interpreted as sensor data with 8 to 12
/// significant bits. Transparent pixels are composited on white. If a TIFF file has several pages,
/// the requested page is read. The default is the first page.
///
/// The orientation in EXIF data and HEIC files is ignored, because the calibration and mount of a
/// camera refer to the pixels of the sensor.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/grey_image.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Limits for images that can be read: the maximum side length, the maximum number of pixels, and
/// the default value of the `max_pixels` parameter of `read_image`.
inline constexpr int kMaxImageSide_px = 100'000;
inline constexpr int kMaxImagePixels = 1 << 28;
inline constexpr int kDefaultImagePixels = 100'000'000;

/// Thrown if an image has more pixels than the limit, according to its header. The pixels of
/// such an image are not decoded.
struct ImageTooLarge : Error {
    ImageTooLarge(const std::string& what, int width, int height)
        : Error(what), width_px(width), height_px(height) {}
    int width_px;
    int height_px;
};

/// Reads one image. `page` is the number of the page in a TIFF file, from 1. Reading needs up to 15
/// bytes of memory per pixel, in addition to the contents of the file. Throws ImageTooLarge if the
/// image has more than `max_pixels` or kMaxImagePixels pixels. Thread-safe.
///
/// Throws Error in these cases. The message contains the name of the file and the reason.
/// - The file or the page does not exist, or the file is a directory or cannot be accessed.
/// - The file is empty, truncated or damaged, or its image format is unknown.
/// - The file is larger than 8 * max_pixels bytes + 1 MiB, or there is not enough memory.
GreyImage read_image(const std::filesystem::path& path, int max_pixels = kDefaultImagePixels,
                     int page = 1);

/// Variant of `read_image` that also sets `note` to a sentence for the user about the file, for
/// example that the end marker is missing. If there is nothing to report, sets `note` to an empty
/// string.
GreyImage read_image(const std::filesystem::path& path, int max_pixels, std::string& note,
                     int page = 1);

/// Returns the number of pages in a file. Only TIFF files can have more than one page. Returns 1
/// for anything other than a regular file, such as a pipe, without reading it. Throws Error if the
/// file cannot be read (see `read_image`).
int count_pages(const std::filesystem::path& path);

/// Pixels per inch along both axes.
struct Resolution {
    double x_dpi = 0;
    double y_dpi = 0;
};

/// Origin of an image, according to the metadata in its file.
struct ImageOrigin {
    /// True if the image is from a camera: its EXIF data (JPEG, PNG, TIFF, WebP, HEIC) contain an
    /// exposure time, f-number, sensitivity or focal length.
    bool is_photo = false;
    /// Resolution of a scan: PNG pHYs, JPEG density, TIFF and BMP resolution. None if the image is
    /// a photo or if the resolution is missing. Also none if the resolution is 72 or 96 dpi,
    /// because programs write these defaults if they do not know the resolution.
    std::optional<Resolution> resolution;
};

/// Returns the origin of an image without decoding its pixels. Throws Error if the file cannot be
/// read (see `read_image`).
ImageOrigin read_origin(const std::filesystem::path& path, int page = 1);

/// Formats in which grey images are encoded.
enum class ImageEncoding : std::uint8_t {
    png,   ///< lossless
    jpeg,  ///< lossy, with a quality of 95
    pgm,   ///< lossless and uncompressed
};

/// Encodes an image, and returns the contents of the image file. Throws Error if the image is empty
/// or the encoder fails.
std::vector<std::uint8_t> encode_image(ImageEncoding encoding, ImageView image);

/// Writes a binary PGM file (P5). Replaces an existing file. Throws Error if the image is empty or
/// the file cannot be written.
void write_pgm(const std::filesystem::path& path, ImageView image);

/// Writes an 8-bit grey PNG file. Replaces an existing file. Identical images produce identical
/// files. Throws Error if the image is empty or the file cannot be written.
void write_png(const std::filesystem::path& path, ImageView image);

}  // namespace dotpose

DOTPOSE_END_EXPORT

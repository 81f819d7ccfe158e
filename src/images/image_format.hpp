/// Detects the formats of image files and decodes the images. image_file.hpp describes the
/// conversions and limits. Error messages contain only the reason, and the caller adds the file
/// name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::images {

using Bytes = std::span<const std::uint8_t>;

/// A file in memory and the limits for decoding it.
struct ImageInput {
    Bytes file;
    int page = 1;  ///< page number in a TIFF file, counted from 1
    int max_pixels = kDefaultImagePixels;
};

struct ImageFormat {
    /// Returns true if `head`, the first bytes of a file, contains the signature of this format.
    bool (*matches)(std::string_view head);
    /// Decodes an image. Sets `note` as `read_image` does, but without the name of the file.
    GreyImage (*decode)(const ImageInput& input, std::string& note);
    /// Returns the origin and the resolution from the metadata of the file. The resolution may be a
    /// default value set by the program that wrote the file.
    ImageOrigin (*origin)(const ImageInput& input);
    /// Returns the number of pages. The pointer is null if files of this format have only one page.
    int (*count_pages)(Bytes file) = nullptr;
};

/// Number of bytes needed from the beginning of a file to identify its format.
inline constexpr std::size_t kMagicBytes = 12;

/// Detects the format from the first bytes of a file. Returns null for unknown formats.
const ImageFormat* format_of(Bytes head);

/// A known format that this build cannot read.
struct OtherFormat {
    bool (*matches)(std::string_view head);
    const char* name;    ///< for example "a GIF image"
    const char* remedy;  ///< instructions for converting it to a supported format
};
/// Detects a known format that this build cannot read, from the first bytes of a file. Returns null
/// for other files.
const OtherFormat* other_format_of(Bytes head);

// Functions for the individual formats. Each format has its own source file.
GreyImage decode_bmp(const ImageInput& input, std::string& note);
ImageOrigin bmp_origin(const ImageInput& input);
GreyImage decode_heif(const ImageInput& input, std::string& note);
ImageOrigin heif_origin(const ImageInput& input);
GreyImage decode_jpeg(const ImageInput& input, std::string& note);
ImageOrigin jpeg_origin(const ImageInput& input);
GreyImage decode_png(const ImageInput& input, std::string& note);
ImageOrigin png_origin(const ImageInput& input);
GreyImage decode_pnm(const ImageInput& input, std::string& note);
GreyImage decode_tiff(const ImageInput& input, std::string& note);
ImageOrigin tiff_origin(const ImageInput& input);
int tiff_pages(Bytes file);
GreyImage decode_webp(const ImageInput& input, std::string& note);
ImageOrigin webp_origin(const ImageInput& input);

/// Encode an image as grey JPEG with a quality of 95, or as binary PGM. The image must not be
/// empty.
std::vector<std::uint8_t> encode_jpeg(ImageView image);
std::vector<std::uint8_t> encode_pgm(ImageView image);

/// Throws Error if a side exceeds kMaxImageSide_px, and ImageTooLarge if the image has too many
/// pixels.
void require_size(std::uint64_t width_px, std::uint64_t height_px, int max_pixels);

inline constexpr double kMetresPerInch = 0.0254;
inline constexpr double kCentimetresPerInch = 2.54;

/// Converts a resolution to dots per inch. Returns an empty optional if a value is not positive,
/// that is, if the resolution is unknown.
std::optional<Resolution> resolution_from(double x, double y, double units_per_inch);

/// EXIF tags that are written by cameras but not by scanners (CIPA DC-008): exposure time,
/// f-number, sensitivity and focal length.
inline constexpr std::array<std::uint16_t, 4> kCameraTags{0x829A, 0x829D, 0x8827, 0x920A};

/// Returns true if EXIF data contain one of kCameraTags. The data may begin with the identifier
/// "Exif" or directly with the TIFF header. Entries that are truncated or damaged are treated as
/// missing.
bool is_of_camera(Bytes exif);

}  // namespace dotpose::images

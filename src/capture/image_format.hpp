/// Examines the bytes of an image file without decoding it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {

enum class ImageFormat : std::uint8_t { pnm, png, jpeg, bmp, tiff };

/// Number of bytes that `sniff` needs.
inline constexpr std::size_t kMagicBytes = 12;

inline constexpr double kMetresPerInch = 0.0254;
inline constexpr double kCentimetresPerInch = 2.54;

/// Converts a resolution to dots per inch. Returns none for values of 0 or less, which mean an
/// unknown resolution.
std::optional<Resolution> resolution_from(double x, double y, double units_per_inch);

/// Throws Error if a side exceeds the limit, and ImageTooLarge if the image has too many pixels.
void require_size(std::uint64_t width_px, std::uint64_t height_px, int max_pixels);

/// Detects the format from the first bytes of a file. Returns none for unknown bytes.
std::optional<ImageFormat> sniff(std::span<const std::uint8_t> bytes);

/// An unsupported image format.
struct OtherFormat {
    const char* name;    ///< for example "a WebP image"
    const char* remedy;  ///< instructions for converting it to a supported format
};
/// Detects an unsupported format from the first bytes of a file. Returns none for other files.
std::optional<OtherFormat> sniff_other(std::span<const std::uint8_t> bytes);

/// Returns "PNM", "PNG", "JPEG", "BMP" or "TIFF".
const char* name(ImageFormat format);

}  // namespace dotpose::capture

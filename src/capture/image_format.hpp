/// Examines the bytes of an image file without decoding it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace dotpose::capture {

enum class ImageFormat : std::uint8_t { pnm, png, jpeg, bmp, tiff };

/// Number of bytes that `sniff` needs.
inline constexpr std::size_t kMagicBytes = 12;

/// The message for images above the limits.
inline constexpr char kTooLarge[] =
    "the image is too large: at most 100,000 px per side and 2^28 px are read";

/// Throws Error if a side is beyond the limit, ImageTooLarge if there are too many pixels.
void require_size(std::uint64_t width_px, std::uint64_t height_px, int max_pixels);

/// Returns the level of white in an image of 16 bits whose largest level is `largest`: of 8 to 12
/// bits, as sensors deliver them in the lower bits of 16, the largest of these bits.
std::uint32_t white_level(std::uint32_t largest);

/// Returns the format that the first bytes of a file indicate, or none.
std::optional<ImageFormat> sniff(std::span<const std::uint8_t> bytes);

/// A kind of image that is not read.
struct OtherFormat {
    const char* name;    ///< such as "a WebP image"
    const char* remedy;  ///< what makes it one that is read
};
/// Returns the format that is not read and that the first bytes of a file indicate, or none.
std::optional<OtherFormat> sniff_other(std::span<const std::uint8_t> bytes);

/// Returns "PNM", "PNG", "JPEG", "BMP" or "TIFF".
const char* name(ImageFormat format);

/// Returns the number of pages: TIFF may have several, all others have one.
int pages_of(ImageFormat format, std::span<const std::uint8_t> bytes);

/// Whether the file's own structure (chunks, sizes, offsets, end marker) reaches beyond its end. Of
/// a TIFF, one page is examined.
/// PNM has no such structure: always false.
bool is_cut_short(ImageFormat format, std::span<const std::uint8_t> bytes, int page = 1);

/// Whether a PNG has a side above kMaxImageSide_px, which its decoder reports only as a bad header.
/// Returns false for other formats.
bool is_too_large(ImageFormat format, std::span<const std::uint8_t> bytes);

}  // namespace dotpose::capture

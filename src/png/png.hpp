/// Writes grey PNG images with libpng. All libraries that write images use these functions.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/byte_sink.hpp"
#include "dotpose/export.hpp"
#include "dotpose/image.hpp"

// These declarations are exported because several libraries use them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::png {

struct Header {
    int width_px = 0;
    int height_px = 0;
    int bits_per_px = 8;  ///< 8 (0 is black) or 1 (1 is black; a byte contains 8 pixels)
    double dpi = 0;       ///< resolution in dots per inch, or 0 if unknown
};

using RowSink = std::function<void(std::span<const std::uint8_t>)>;
/// Calls the sink with each row of an image, from top to bottom.
using RowSource = std::function<void(const RowSink&)>;

/// Writes an image. Throws Error if libpng fails or the file cannot be written.
void write(const Header& header, const RowSource& rows, base::ByteSink& file);

/// Encodes an image as PNG. The image must not be empty. Identical images are encoded as identical
/// bytes. Throws Error if libpng fails.
std::vector<std::uint8_t> encode(ImageView image);

}  // namespace dotpose::png

DOTPOSE_END_EXPORT

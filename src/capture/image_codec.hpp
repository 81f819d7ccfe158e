/// Decodes the contents of image files to grey images. image_file.hpp describes the conversions and
/// limits.
#pragma once

#include <optional>
#include <string>

#include "capture/bytes.hpp"
#include "capture/image_format.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {

/// Decodes an image. `note` is set as by `read_image`, without the name of the file. Throws Error
/// with only the reason; the caller adds the name of the file.
GreyImage decode_image(ImageFormat format, Bytes file, int max_pixels, std::string& note,
                       int page = 1);

/// Returns the resolution stored in the file, without decoding the pixels. Throws Error with only
/// the reason.
std::optional<Resolution> decode_resolution(ImageFormat format, Bytes file, int page = 1);

/// Returns the number of pages: 1 unless the file is a TIFF. Throws Error with only the reason.
int pages_of(ImageFormat format, Bytes file);

}  // namespace dotpose::capture

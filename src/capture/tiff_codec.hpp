/// Reads TIFF with libtiff.
#pragma once

#include <optional>

#include "capture/bytes.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/image_file.hpp"

namespace dotpose::capture {

/// The functions throw Error with only the reason. `page` is counted from 1.
GreyImage decode_tiff(Bytes file, int max_pixels, int page);
std::optional<Resolution> tiff_resolution(Bytes file, int page);

/// Returns the number of pages.
int tiff_pages(Bytes file);

}  // namespace dotpose::capture

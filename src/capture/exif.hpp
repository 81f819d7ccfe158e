/// Reads the EXIF data of an image file.
#pragma once

#include "capture/bytes.hpp"
#include "capture/image_format.hpp"

namespace dotpose::capture {

/// Returns true if the EXIF data contain an entry that cameras write, but scanners do not: exposure
/// time, f-number, sensitivity or focal length. Truncated or damaged EXIF data are treated as
/// missing.
bool is_from_camera(ImageFormat format, Bytes file);

}  // namespace dotpose::capture

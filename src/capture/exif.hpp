/// Reads the EXIF data of an image file.
#pragma once

#include "capture/bytes.hpp"
#include "capture/image_format.hpp"

namespace dotpose::capture {

/// Whether a file has EXIF data of a camera: exposure time, f-number, sensitivity or focal length,
/// which scanners do not write. Truncated or damaged data count as missing.
bool is_from_camera(ImageFormat format, Bytes file);

}  // namespace dotpose::capture

// Pale: tests whether the dots of a fix have less contrast than the options require.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// Returns true if the mean contrast of the dots around the image centre is below
/// `options.min_contrast` grey levels. Returns false if this option is 0 or if none of these dots
/// is in the image. `code` is the code of the fix.
bool is_pale(const ImageView& image, const DeviceOptions& options, CodeVariant code,
             const Fix& fix);

}  // namespace dotpose::core

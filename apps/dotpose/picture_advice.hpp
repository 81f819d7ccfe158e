/// Finds out from a picture of a sheet why it could not be located, and what would help.
#pragma once

#include <string>

#include "dotpose/image.hpp"
#include "dotpose/memory.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::cli {

/// Returns a sentence without a full stop, or an empty text if the picture gives no reason.
/// `status` is the result of `locate` with `options`; `scratch` is overwritten. `bits_per_px` is
/// what a lossy compression of the video has left (capture/frame_source.hpp), or 0.
std::string advice_on(ImageView image, Status status, const Options& options, LargeMemory& scratch,
                      double bits_per_px = 0);

}  // namespace dotpose::cli

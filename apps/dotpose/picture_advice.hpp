/// Determines why a picture of a sheet cannot be located and suggests a remedy.
#pragma once

#include <string>

#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "dotpose/memory.hpp"
#include "dotpose/status.hpp"

namespace dotpose::cli {

/// The result of `locate` for a picture, and other facts on which the advice depends.
struct PictureFacts {
    Status status = Status::ok;  ///< result of `locate` with `options`
    DeviceOptions options;
    bool code_is_given = true;  ///< true if only one code was tried
    /// Bits per pixel of a compressed video (capture/frame_source.hpp), or 0 if unknown.
    double bits_per_px = 0;
};

/// Returns the advice as a sentence without a full stop, or an empty string if no reason was found.
/// Overwrites `scratch`.
std::string advice_on(ImageView image, const PictureFacts& facts, LargeMemory& scratch);

}  // namespace dotpose::cli

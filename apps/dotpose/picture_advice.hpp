/// Finds out from a picture of a sheet why it could not be located, and what would help.
#pragma once

#include <string>

#include "dotpose/image.hpp"
#include "dotpose/memory.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::cli {

/// The result for a picture, and the settings that advice depends on.
struct PictureFacts {
    Status status = Status::ok;  ///< result of `locate` with `options`
    Options options;
    bool code_is_given = true;  ///< whether only one code was tried
    /// Bits per pixel of a compressed video (capture/frame_source.hpp); 0 if they are not known.
    double bits_per_px = 0;
};

/// Returns a sentence without a full stop, or an empty text if the picture gives no reason.
/// `scratch` is overwritten.
std::string advice_on(ImageView image, const PictureFacts& facts, LargeMemory& scratch);

}  // namespace dotpose::cli

/// Why a picture of a sheet could not be located, as far as the picture tells, and what would help.
#pragma once

#include <string>

#include "dotpose/image.hpp"
#include "dotpose/memory.hpp"
#include "dotpose/options.hpp"
#include "dotpose/status.hpp"

namespace dotpose::cli {

/// A sentence without a full stop; empty if the picture tells nothing. `status` is what `locate`
/// said of it with `options`; `scratch` is overwritten.
std::string advice_on(ImageView image, Status status, const Options& options, LargeMemory& scratch);

}  // namespace dotpose::cli

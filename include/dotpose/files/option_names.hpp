/// Names of option values, as used on the command line and in tables, and messages about them.
#pragma once

#include <array>
#include <string>

#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// All values of Decoder and Effort, for iteration.
inline constexpr std::array kDecoders = {Decoder::window, Decoder::all};
inline constexpr std::array kEfforts = {Effort::device, Effort::once, Effort::twice};
/// Return the name of an option value, for example "window" or "twice".
const char* name(Decoder decoder);
const char* name(Effort effort);

/// Returns a message about the first option outside its range, with the name of the option and the
/// range. Returns an empty string if all options are valid.
std::string fault_text(const DeviceOptions& options);

}  // namespace dotpose

DOTPOSE_END_EXPORT

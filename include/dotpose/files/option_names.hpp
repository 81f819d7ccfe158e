/// Names of option values, as used on the command line and in tables, and error messages about
/// invalid options.
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

/// Returns an error message about the first option that is out of range. The message contains the
/// name of the option and the permitted range. Returns an empty string if all options are valid.
std::string fault_text(const DeviceOptions& options);

}  // namespace dotpose

DOTPOSE_END_EXPORT

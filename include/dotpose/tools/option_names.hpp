/// Names of option values, as used on the command line and in tables, and messages about them.
#pragma once

#include <array>
#include <string>

#include "dotpose/options.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// All values of Decoder and of Effort, for tables.
inline constexpr std::array kDecoders = {Decoder::window, Decoder::all};
inline constexpr std::array kEfforts = {Effort::device, Effort::once, Effort::twice};
/// Return the name of an option value, such as "window" and "twice".
const char* name(Decoder decoder);
const char* name(Effort effort);

/// Returns a sentence with the option outside its range, and the range; empty if there is none.
std::string fault_text(const Options& options);

}  // namespace dotpose

#pragma GCC visibility pop

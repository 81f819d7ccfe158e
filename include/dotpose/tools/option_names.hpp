/// The names of option values, as the command line takes them and tables show them.
#pragma once

#include <array>

#include "dotpose/options.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

inline constexpr std::array kDecoders = {Decoder::window, Decoder::all};
inline constexpr std::array kEfforts = {Effort::device, Effort::once, Effort::twice};
const char* name(Decoder decoder);
const char* name(Effort effort);

}  // namespace dotpose

#pragma GCC visibility pop

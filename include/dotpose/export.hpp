/// Macros that enclose the declarations exported by the shared libraries. All other symbols are
/// hidden. On Windows, the macros are empty, because Mingw-w64 exports all symbols.
#pragma once

#include "dotpose/language.hpp"

#if defined(__GNUC__) && !defined(_WIN32)
#define DOTPOSE_BEGIN_EXPORT _Pragma("GCC visibility push(default)")
#define DOTPOSE_END_EXPORT _Pragma("GCC visibility pop")
#else
#define DOTPOSE_BEGIN_EXPORT
#define DOTPOSE_END_EXPORT
#endif

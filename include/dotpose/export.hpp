/// Macros around declarations whose names a shared library of dotpose exports. All other names are
/// hidden. On Windows, the build exports all names instead.
#pragma once

#include "dotpose/export.hpp"

#if defined(__GNUC__) && !defined(_WIN32)
#define DOTPOSE_BEGIN_EXPORT _Pragma("GCC visibility push(default)")
#define DOTPOSE_END_EXPORT _Pragma("GCC visibility pop")
#else
#define DOTPOSE_BEGIN_EXPORT
#define DOTPOSE_END_EXPORT
#endif

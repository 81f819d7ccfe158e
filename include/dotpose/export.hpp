/// Macros around the declarations whose names the shared libraries of dotpose export. All other
/// names are hidden. For Windows the macros are empty: Mingw-w64 exports all names of a library.
#pragma once

#if defined(__GNUC__) && !defined(_WIN32)
#define DOTPOSE_BEGIN_EXPORT _Pragma("GCC visibility push(default)")
#define DOTPOSE_END_EXPORT _Pragma("GCC visibility pop")
#else
#define DOTPOSE_BEGIN_EXPORT
#define DOTPOSE_END_EXPORT
#endif

/// Stops compilation with a clear error message if the compiler does not support C++20, which all
/// headers require.
#pragma once

// Also checks _MSVC_LANG, because Microsoft's compiler sets __cplusplus correctly only with the
// option /Zc:__cplusplus.
#if __cplusplus < 202002L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "dotpose needs C++20: compile with -std=c++20, GCC 12 or clang 14 or later"
#endif

/// Checks that the compiler is set to the language that all headers need, before anything fails
/// without it.
#pragma once

#if __cplusplus < 202002L
#error "dotpose needs C++20: compile with -std=c++20, GCC 12 or clang 14 or later"
#endif

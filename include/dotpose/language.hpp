/// The language that all headers need, said before anything that fails without it.
#pragma once

#if __cplusplus < 202002L
#error "dotpose needs C++20: compile with -std=c++20, GCC 12 or clang 14 or later"
#endif

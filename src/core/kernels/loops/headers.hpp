// Headers for the loops. Include this file before an implementation opens its namespace.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "code/tables.hpp"
#include "core/kernels/select.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {

/// True if only the general version of each loop is compiled, without faster special cases.
/// WebAssembly builds use this to keep the code small.
#if defined(__wasm__)
inline constexpr bool kOneForm = true;
#else
inline constexpr bool kOneForm = false;
#endif

}  // namespace dotpose::core

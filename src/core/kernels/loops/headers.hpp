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

/// True if each loop has only its general version, without faster special cases. This is the case
/// in WebAssembly builds, because their code must be small.
#if defined(__wasm__)
inline constexpr bool kOneForm = true;
#else
inline constexpr bool kOneForm = false;
#endif

}  // namespace dotpose::core

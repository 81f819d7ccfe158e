// Headers required by the loops. Must be included before the namespace of an implementation begins.
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

namespace dotpose::core {

/// True if loops have one version for all cases instead of a faster version for each case. For
/// WebAssembly, code size matters more than speed.
#if defined(__wasm__)
inline constexpr bool kOneForm = true;
#else
inline constexpr bool kOneForm = false;
#endif

}  // namespace dotpose::core

// Headers of the loops, which have to come before the namespace of a form begins.
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

// AVX2 implementation of the kernels, with 32-byte vectors. Only the code between the pragmas is
// compiled for AVX2. The headers are included before the pragmas, because the linker keeps only one
// copy of each inline function in them, and this copy must run on every processor.
#include "core/kernels/loops/headers.hpp"

#if defined(__x86_64__)

#define DOTPOSE_LANE_BYTES 32
#define DOTPOSE_KERNELS_NAME "avx2"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi,bmi2,lzcnt,popcnt")
#endif
namespace dotpose::core {
namespace {
#include "core/kernels/loops/all.inc"
}  // namespace
}  // namespace dotpose::core
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace dotpose::core {
const Kernels* avx2_kernels() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") ? &kKernels : nullptr;
}
}  // namespace dotpose::core

#else

namespace dotpose::core {
const Kernels* avx2_kernels() {
    return nullptr;
}
}  // namespace dotpose::core

#endif

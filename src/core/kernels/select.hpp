// Select: chooses the kernels for the current processor.
#pragma once

#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns scalar kernels for any processor. Tests compare the other kernels with them.
const Kernels& portable_kernels();
/// Returns kernels with 16-byte vectors, for x86-64, 64-bit ARM, and WebAssembly with SIMD.
const Kernels& wide_kernels();
/// Returns AVX2 kernels, or null if the processor lacks AVX2 or BMI2.
const Kernels* avx2_kernels();

/// Returns the fastest kernels for this processor.
const Kernels& kernels();

}  // namespace dotpose::core

// Select: chooses the kernels for the current processor.
#pragma once

#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns scalar kernels, for any processor. Tests compare all other kernels with these kernels.
const Kernels& portable_kernels();
/// Returns kernels with vectors of 16 bytes, for all x86-64 and 64-bit ARM processors and for
/// WebAssembly with SIMD instructions.
const Kernels& wide_kernels();
/// Returns kernels for AVX2, or null if the processor does not support AVX2 and BMI2.
const Kernels* avx2_kernels();

/// Returns the fastest kernels for this processor.
const Kernels& kernels();

}  // namespace dotpose::core

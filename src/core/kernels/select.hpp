// Select: the kernels for the processor that the program runs on.
#pragma once

#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Returns kernels with plain numbers, for any processor; the others are compared with these.
const Kernels& portable_kernels();
/// Returns kernels with vectors of 16 bytes, which every x86-64 and 64-bit ARM processor has.
const Kernels& wide_kernels();
/// Returns kernels for AVX2; null if the processor or the compiler does not have it.
const Kernels* avx2_kernels();

/// Returns the fastest kernels for this processor.
const Kernels& kernels();

}  // namespace dotpose::core

// Select: the kernels for the processor at hand.
#pragma once

#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Plain numbers, for any processor: the reference for the others.
const Kernels& portable_kernels();
/// Vectors of 16 bytes, which every x86-64 and 64-bit ARM has.
const Kernels& wide_kernels();
/// AVX2; null where the processor or the compiler has none.
const Kernels* avx2_kernels();

/// The fastest of them here.
const Kernels& kernels();

}  // namespace dotpose::core

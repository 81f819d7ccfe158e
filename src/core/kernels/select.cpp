#include "core/kernels/select.hpp"

namespace dotpose::core {

const Kernels& kernels() {
#if defined(__wasm__) && !defined(__wasm_simd128__)
    // Without SIMD instructions, compilers would split each vector into scalars, so the scalar
    // kernels are faster.
    return portable_kernels();
#else
    const Kernels* avx2 = avx2_kernels();
    return avx2 != nullptr ? *avx2 : wide_kernels();
#endif
}

}  // namespace dotpose::core

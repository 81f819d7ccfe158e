#include "core/kernels/select.hpp"

namespace dotpose::core {

const Kernels& kernels() {
    const Kernels* avx2 = avx2_kernels();
    return avx2 != nullptr ? *avx2 : wide_kernels();
}

}  // namespace dotpose::core

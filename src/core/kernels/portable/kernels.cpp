// Scalar kernel implementation.
#include "core/kernels/loops/headers.hpp"

#define DOTPOSE_LANE_BYTES 0
#define DOTPOSE_KERNELS_NAME "portable"

namespace dotpose::core {
namespace {
#include "core/kernels/loops/all.inc"
}  // namespace

const Kernels& portable_kernels() {
    return kKernels;
}

}  // namespace dotpose::core

// Kernel implementation with 16-byte vectors.
#include "core/kernels/loops/headers.hpp"

#define DOTPOSE_LANE_BYTES 16
#define DOTPOSE_KERNELS_NAME "16 bytes"

namespace dotpose::core {
namespace {
#include "core/kernels/loops/all.inc"
}  // namespace

const Kernels& wide_kernels() {
    return kKernels;
}

}  // namespace dotpose::core

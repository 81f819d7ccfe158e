#include "core/decode/upright.hpp"

namespace dotpose::core {

// Not inlined, because inlining would double the size of each caller.
std::span<const std::int8_t> Upright::weights(const GridCell* cell, int stride, int count,
                                              std::int8_t GridCell::*bit, int sign, Line& line) {
    std::int8_t* weight = line.data();
#pragma GCC unroll 4
    for (int i = 0, at = 0; i < count; ++i, at += stride)
        *weight++ = static_cast<std::int8_t>(cell[at].*bit * sign);
    return std::span(line).first(static_cast<std::size_t>(count));
}

}  // namespace dotpose::core

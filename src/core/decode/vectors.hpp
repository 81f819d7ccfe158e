// Vectors: arithmetic on several numbers at once, in vector instructions where there are any.
#pragma once

#include <cstdint>
#include <cstring>

namespace dotpose::core {

using Eight = std::int16_t __attribute__((vector_size(16)));
using FourWords = std::uint32_t __attribute__((vector_size(16)));

/// Numbers in a row in memory.
inline Eight eight_at(const std::int16_t* first) {
    Eight eight;
    std::memcpy(&eight, first, sizeof eight);
    return eight;
}
inline FourWords four_at(const std::uint32_t* first) {
    FourWords four;
    std::memcpy(&four, first, sizeof four);
    return four;
}

inline Eight larger(Eight a, Eight b) {
    return a > b ? a : b;
}
inline Eight smaller(Eight a, Eight b) {
    return a < b ? a : b;
}

}  // namespace dotpose::core

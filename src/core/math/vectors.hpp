// Vectors: arithmetic on four numbers at a time. Compiled to vector instructions if the processor
// has them.
#pragma once

#include <cstdint>
#include <cstring>

namespace dotpose::core {

using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

/// Loads adjacent numbers into a vector. The address does not have to be aligned.
template <typename Vector, typename Number>
Vector vector_at(const Number* first) {
    static_assert(sizeof(Vector{}[0]) == sizeof(Number));
    Vector vector;
    std::memcpy(&vector, first, sizeof vector);
    return vector;
}
inline Four four_at(const float* first) {
    return vector_at<Four>(first);
}
inline FourInts four_at(const std::int32_t* first) {
    return vector_at<FourInts>(first);
}

/// Adds all elements of `a` to sums[0], all elements of `b` to sums[1], and so on. The elements of
/// each vector are added in index order.
inline void add_each(Four& sums, Four a, Four b, Four c, Four d) {
    const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Four ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Four cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    sums += __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    sums += __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    sums += __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    sums += __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

}  // namespace dotpose::core

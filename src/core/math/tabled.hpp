// Tabled: look-up tables for functions of small integers. On processors without a divide
// instruction, a look-up is faster than a function that divides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dotpose::core {

/// Returns kFunction(n) for n < kCount, from a table built at compile time. On targets that have a
/// divide instruction but little flash memory, and in WebAssembly, where the code must be small,
/// calls the function instead.
template <std::uint32_t (*kFunction)(std::uint32_t), std::uint32_t kCount>
std::uint32_t tabled(std::uint32_t n) {
#if defined(__wasm__) || defined(__mips__) || defined(__riscv_div) || \
    (defined(__arm__) && defined(__ARM_FEATURE_IDIV))
    return kFunction(n);
#else
    static constexpr auto kValues = [] {
        std::array<std::uint32_t, kCount> values{};
        for (std::uint32_t i = 0; i < kCount; ++i)
            values[i] = kFunction(i);
        return values;
    }();
    return kValues[n];
#endif
}

}  // namespace dotpose::core

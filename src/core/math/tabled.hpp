// Tabled: a function of small numbers whose values are divisions, which small processors lack.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dotpose::core {

/// Returns kFunction(n) for n < kCount. It is read from a table that the compiler makes;
/// WebAssembly divides, as each table would be a kilobyte more to download.
template <std::uint32_t (*kFunction)(std::uint32_t), std::uint32_t kCount>
std::uint32_t tabled(std::uint32_t n) {
#ifdef __wasm__
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

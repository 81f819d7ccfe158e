/// Serial line of the nRF51822 (Reference Manual, chapter 29: UART).
#pragma once

#include <cstdint>

namespace emulated_uart {

inline volatile std::uint32_t& at(std::uint32_t offset) {
    constexpr std::uintptr_t kUart0 = 0x40002000;
    return *reinterpret_cast<volatile std::uint32_t*>(kUart0 + offset);
}

/// Sends a byte. Waits until the previous byte has been sent.
inline void put(std::uint8_t byte) {
    constexpr std::uint32_t kStartTx = 0x008;
    constexpr std::uint32_t kTxReady = 0x11C;
    constexpr std::uint32_t kEnable = 0x500;
    constexpr std::uint32_t kTxd = 0x51C;
    constexpr std::uint32_t kEnabled = 4;
    static bool is_on = false;
    if (!is_on) {
        at(kEnable) = kEnabled;
        at(kStartTx) = 1;
        is_on = true;
    }
    at(kTxReady) = 0;
    at(kTxd) = byte;
    while (at(kTxReady) == 0) {
    }
}

}  // namespace emulated_uart

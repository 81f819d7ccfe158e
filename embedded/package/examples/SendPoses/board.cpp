// Placeholder for a board. Replace this file with the port for your board. extras/boards contains
// ports for ESP32-CAM, RP2040 and STM32. This placeholder has no camera and delivers white frames,
// so packets with the status `no_contrast` show that everything except the camera works.
#include "board.hpp"

#include <Arduino.h>

namespace board {
namespace {

constexpr int kWidth_px = board::kMaxWidth_px;
constexpr int kHeight_px = board::kMaxHeight_px;
std::uint8_t row[kWidth_px];

// Returns the time in µs on a 64-bit clock, because micros() wraps around after 71 minutes.
std::int64_t now_us() {
    static std::uint32_t last = 0;
    static std::int64_t total_us = 0;
    const std::uint32_t now = micros();
    total_us += static_cast<std::uint32_t>(now - last);
    last = now;
    return total_us;
}

}  // namespace

Frame start_frame(std::int64_t not_before_us) {
    static bool is_set_up = false;
    if (!is_set_up) Serial.begin(115200);
    is_set_up = true;
    while (now_us() < not_before_us) {
    }
    return {kWidth_px, kHeight_px, now_us()};
}

const std::uint8_t* next_row() {
    for (std::uint8_t& grey : row)
        grey = 200;
    return row;
}

void send(const std::uint8_t* bytes, std::size_t count) {
    Serial.write(bytes, count);
}

}  // namespace board

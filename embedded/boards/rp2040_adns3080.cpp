// Port for a Raspberry Pi Pico (RP2040) with the Pico SDK and an ADNS-3080, an optical mouse sensor
// with 30 x 30 px. The sensor is read over SPI. The port was compiled against stubs of the SDK, but
// has never been run.
//
// The sensor sees about 5 x 5 cells. This is enough for a fix only if sheets are known, and even
// then rarely in a single frame. Add `locator_.set_known(kSheets, OtherSheets::impossible)` to
// PoseSender, with the regions of your sheets as constants. Build with -DDOTPOSE_FRAME_WIDTH_PX=36
// -DDOTPOSE_FRAME_HEIGHT_PX=36. The lens must image the pattern at 5 to 6 px per spacing
// (docs/hardware.md). Link with pico_stdlib hardware_spi.
//
//     ADNS-3080   SCLK   MOSI   MISO   NCS   RESET   NPD   line   TX
//     Pico        GP18   GP19   GP16   GP17  GP20    3V3          GP0
#include <algorithm>

#include <hardware/spi.h>
#include <hardware/uart.h>
#include <pico/stdlib.h>

#include "board.hpp"

namespace {

constexpr uint kMiso = 16;
constexpr uint kSelect = 17;
constexpr uint kClock = 18;
constexpr uint kMosi = 19;
constexpr uint kReset = 20;
constexpr uint kTx = 0;

constexpr int kSide_px = 30;
static_assert(kSide_px <= board::kMaxWidth_px);

// Registers and times from the data sheet.
constexpr std::uint8_t kConfiguration = 0x0A;
constexpr std::uint8_t kFrameCapture = 0x13;
constexpr std::uint8_t kPixelBurst = 0x40;
constexpr std::uint8_t kWrite = 0x80;
constexpr std::uint8_t kCapture = 0x83;
constexpr std::uint64_t kReadDelay_us = 50;
constexpr std::uint64_t kWriteDelay_us = 50;
constexpr std::uint64_t kBetweenPixels_us = 10;
/// Time from the command to the end of the capture: three frames at the lowest frame rate, 2000 per
/// second.
constexpr std::uint64_t kCapture_us = 1510;

std::uint8_t pixels[kSide_px][kSide_px];
int next = 0;

std::uint8_t transfer(std::uint8_t byte) {
    std::uint8_t answer = 0;
    spi_write_read_blocking(spi0, &byte, &answer, 1);
    return answer;
}

void write(std::uint8_t address, std::uint8_t value) {
    gpio_put(kSelect, false);
    transfer(address | kWrite);
    transfer(value);
    gpio_put(kSelect, true);
    sleep_us(kWriteDelay_us);
}

void set_up() {
    uart_init(uart0, 115200);
    gpio_set_function(kTx, GPIO_FUNC_UART);
    spi_init(spi0, 2'000'000);
    spi_set_format(spi0, 8, SPI_CPOL_1, SPI_CPHA_1, SPI_MSB_FIRST);
    for (const uint pin : {kMiso, kClock, kMosi})
        gpio_set_function(pin, GPIO_FUNC_SPI);
    for (const uint pin : {kSelect, kReset}) {
        gpio_init(pin);
        gpio_set_dir(pin, true);
        gpio_put(pin, pin == kSelect);
    }
    gpio_put(kReset, true);
    sleep_us(10);
    gpio_put(kReset, false);
    sleep_us(35'000);
    write(kConfiguration, 0x40);  // the LED is always on
}

/// Reads the pixels of the captured frame, column by column from the lower left corner. Each byte
/// contains the upper six bits of a grey level. The order of the pixels has not been verified on a
/// real sensor. If the status of frames is `mirrored`, reverse the columns.
void read_pixels() {
    gpio_put(kSelect, false);
    transfer(kPixelBurst);
    sleep_us(kReadDelay_us);
    for (int column = 0; column < kSide_px; ++column) {
        for (int row = kSide_px - 1; row >= 0; --row) {
            pixels[row][column] = static_cast<std::uint8_t>((transfer(0) & 0x3F) << 2);
            sleep_us(kBetweenPixels_us);
        }
    }
    gpio_put(kSelect, true);
    sleep_us(4);  // minimum time that the sensor must be deselected to end the burst
}

}  // namespace

namespace board {

Frame start_frame(std::int64_t not_before_us) {
    static bool is_set_up = false;
    if (!is_set_up) set_up();
    is_set_up = true;
    if (not_before_us > 0)
        sleep_until(from_us_since_boot(static_cast<std::uint64_t>(not_before_us)));
    write(kFrameCapture, kCapture);
    sleep_us(kCapture_us);
    // The sensor captures the third frame after the command. The exposure of this frame has just
    // ended.
    const auto time_us = static_cast<std::int64_t>(time_us_64());
    read_pixels();
    next = 0;
    return {kSide_px, kSide_px, time_us};
}

const std::uint8_t* next_row() {
    return pixels[std::min(next++, kSide_px - 1)];
}

void send(const std::uint8_t* bytes, std::size_t count) {
    uart_write_blocking(uart0, bytes, count);
}

}  // namespace board

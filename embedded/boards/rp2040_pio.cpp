// Port for a Raspberry Pi Pico (RP2040) with the Pico SDK and an OV7670 camera module without FIFO.
// The port was reviewed, but neither compiled nor run.
//
// A PIO state machine samples the bytes from the camera. Every second byte is a grey value (YUYV).
// Two DMA channels write the grey values to two row buffers in turn. Link with pico_stdlib
// hardware_pio hardware_dma hardware_i2c. Focus the lens at a distance of about 27 mm
// (docs/hardware.md).
//
//     camera   D0..D7      PCLK  HREF  VSYNC  XCLK  SIOD  SIOC  RESET  PWDN   line   TX
//     Pico     GP6..GP13   GP14  GP15  GP16   GP21  GP4   GP5   3V3    GND           GP0
#include <hardware/clocks.h>
#include <hardware/dma.h>
#include <hardware/i2c.h>
#include <hardware/pio.h>
#include <hardware/uart.h>
#include <pico/stdlib.h>

#include "board.hpp"

namespace {

constexpr uint kD0 = 6;
constexpr uint kPclk = 14;
constexpr uint kHref = 15;
constexpr uint kVsync = 16;
constexpr uint kXclk = 21;
constexpr uint kSda = 4;
constexpr uint kScl = 5;
constexpr uint kTx = 0;

constexpr int kCameraWidth_px = 320;
constexpr int kCameraHeight_px = 240;
constexpr int kWidth_px = board::kMaxWidth_px;
constexpr int kHeight_px = board::kMaxHeight_px;
constexpr int kLeft = 64;  // a multiple of 4, so that rows can be copied in words
constexpr int kTop = (kCameraHeight_px - kHeight_px) / 2;

alignas(4) std::uint8_t rows[2][kCameraWidth_px];
int channels[2];
int newest = 0;  // index of the row buffer that the next call to next_row() returns
uint machine = 0;
uint program = 0;

struct Setting {
    std::uint8_t address;
    std::uint8_t value;
};

// Settings from the OV7670 implementation guide: QVGA in YUYV format at 15 frames per second with a
// 12.5 MHz clock, and a short, fixed exposure.
constexpr Setting kSettings[] = {
    {0x12, 0x10},                                            // COM7: QVGA, YUV
    {0x0C, 0x04}, {0x3E, 0x19}, {0x70, 0x3A}, {0x71, 0x35},  // halves the image size and PCLK
    {0x72, 0x11}, {0x73, 0xF1}, {0xA2, 0x02}, {0x17, 0x16}, {0x18, 0x04}, {0x32, 0x80},  // window
    {0x19, 0x02}, {0x1A, 0x7A}, {0x03, 0x0A}, {0x13, 0x84},  // COM8: automatic gain, fixed exposure
    {0x10, 0x08}, {0x07, 0x00},                              // exposure, in units of 4 rows
};

void write(const Setting& setting) {
    constexpr std::uint8_t kCamera = 0x21;
    const std::uint8_t bytes[] = {setting.address, setting.value};
    i2c_write_blocking(i2c0, kCamera, bytes, sizeof bytes, false);
}

void set_up_camera() {
    clock_gpio_init(kXclk, CLOCKS_CLK_GPOUT0_CTRL_AUXSRC_VALUE_CLK_SYS, 10);
    i2c_init(i2c0, 100'000);
    for (const uint pin : {kSda, kScl}) {
        gpio_set_function(pin, GPIO_FUNC_I2C);
        gpio_pull_up(pin);
    }
    write({0x12, 0x80});  // reset
    sleep_ms(10);
    for (const Setting& setting : kSettings)
        write(setting);
    sleep_ms(300);
}

/// Sets up a state machine that writes each grey byte to the FIFO and drops the colour byte after
/// it.
void set_up_pio() {
    static std::uint16_t instructions[] = {
        static_cast<std::uint16_t>(pio_encode_wait_gpio(true, kHref)),
        static_cast<std::uint16_t>(pio_encode_wait_gpio(true, kPclk)),
        static_cast<std::uint16_t>(pio_encode_in(pio_pins, 8)),
        static_cast<std::uint16_t>(pio_encode_wait_gpio(false, kPclk)),
        static_cast<std::uint16_t>(pio_encode_wait_gpio(true, kPclk)),
        static_cast<std::uint16_t>(pio_encode_wait_gpio(false, kPclk)),
    };
    constexpr std::uint8_t kCount = sizeof instructions / sizeof instructions[0];
    pio_program_t code{};
    code.instructions = instructions;
    code.length = kCount;
    code.origin = -1;
    program = static_cast<uint>(pio_add_program(pio0, &code));
    machine = static_cast<uint>(pio_claim_unused_sm(pio0, true));
    pio_sm_config config = pio_get_default_sm_config();
    sm_config_set_wrap(&config, program, program + kCount - 1);
    sm_config_set_in_pins(&config, kD0);
    sm_config_set_in_shift(&config, true, true, 8);
    sm_config_set_fifo_join(&config, PIO_FIFO_JOIN_RX);
    pio_sm_init(pio0, machine, program, &config);
}

/// Sets up the two DMA channels. Each channel starts the other when it has filled its row buffer.
void set_up_dma() {
    for (int& channel : channels)
        channel = dma_claim_unused_channel(true);
    // Address of the grey byte in a FIFO word. The state machine shifts to the right, so the grey
    // byte is the most significant byte.
    const volatile void* source = reinterpret_cast<volatile std::uint8_t*>(&pio0->rxf[machine]) + 3;
    for (int i = 0; i < 2; ++i) {
        const auto channel = static_cast<uint>(channels[i]);
        dma_channel_config config = dma_channel_get_default_config(channel);
        channel_config_set_transfer_data_size(&config, DMA_SIZE_8);
        channel_config_set_read_increment(&config, false);
        channel_config_set_write_increment(&config, true);
        channel_config_set_dreq(&config, pio_get_dreq(pio0, machine, false));
        channel_config_set_chain_to(&config, static_cast<uint>(channels[1 - i]));
        dma_channel_configure(channel, &config, rows[i], source, kCameraWidth_px, false);
    }
}

void set_up() {
    uart_init(uart0, 115200);
    gpio_set_function(kTx, GPIO_FUNC_UART);
    for (uint pin = kD0; pin <= kVsync; ++pin)
        gpio_init(pin);  // inputs
    set_up_camera();
    set_up_pio();
    set_up_dma();
}

/// Stops the capture of the previous frame and discards its remaining data.
void stop() {
    pio_sm_set_enabled(pio0, machine, false);
    // Aborting one channel can start the other. Both channels are therefore aborted together, and
    // the abort is repeated once.
    const std::uint32_t both = 1U << channels[0] | 1U << channels[1];
    for (int i = 0; i < 2; ++i) {
        dma_hw->abort = both;
        while (dma_hw->abort & both)
            tight_loop_contents();
    }
    pio_sm_clear_fifos(pio0, machine);
    pio_sm_restart(pio0, machine);
    pio_sm_exec(pio0, machine, pio_encode_jmp(program));
}

}  // namespace

namespace board {

Frame start_frame(std::int64_t not_before_us) {
    static bool is_set_up = false;
    if (!is_set_up) set_up();
    is_set_up = true;
    stop();
    newest = 0;
    for (int i = 0; i < 2; ++i)
        dma_channel_set_write_addr(static_cast<uint>(channels[i]), rows[i], false);
    if (not_before_us > 0)
        sleep_until(from_us_since_boot(static_cast<std::uint64_t>(not_before_us)));
    // Waits until VSYNC falls, which marks the beginning of a frame.
    while (!gpio_get(kVsync))
        tight_loop_contents();
    while (gpio_get(kVsync))
        tight_loop_contents();
    dma_channel_start(static_cast<uint>(channels[0]));
    pio_sm_set_enabled(pio0, machine, true);
    for (int row = 0; row < kTop; ++row)
        next_row();
    // The time of the frame is the time at which its middle row will arrive, half a frame after the
    // first row. The exposure of the middle row ends at about this time.
    constexpr std::int64_t kRow_us = 66'667 / 510;
    return {kWidth_px, kHeight_px,
            static_cast<std::int64_t>(time_us_64()) + kRow_us * kHeight_px / 2};
}

const std::uint8_t* next_row() {
    const auto channel = static_cast<uint>(channels[newest]);
    dma_channel_wait_for_finish_blocking(channel);
    // Resets the write address, because the channel starts again when the other row buffer is full.
    dma_channel_set_write_addr(channel, rows[newest], false);
    const std::uint8_t* row = rows[newest] + kLeft;
    newest = 1 - newest;
    return row;
}

void send(const std::uint8_t* bytes, std::size_t count) {
    uart_write_blocking(uart0, bytes, count);
}

}  // namespace board

// Port for an emulated board with a serial line: qemu-system-arm -M microbit (nRF51822). A file of
// frames replaces the camera. The emulator opens this file for the program.
//
// The file is a sequence of binary PGM images (P5, 8 bits, no comments). The simulated camera
// delivers a frame every 20 ms, even if the program does not read it.
#include "board.hpp"

#include <array>

#include "emulated_uart.hpp"
#include "program.hpp"
#include "semihosting.hpp"
#include "stack.hpp"

int run_device();  // main.cpp

namespace {

constexpr std::int64_t kFrameTime_us = 20'000;

std::int32_t camera = -1;
std::int64_t frames_taken = 0;
int width_px = 0;

// Two row buffers, as on a board with DMA: the program reads one while the camera fills the other.
alignas(4) std::array<std::array<std::uint8_t, board::kMaxWidth_px>, 2> rows;
int filled = 0;

void print(const char* text) {
    static const std::int32_t errors = semihosting::open(":tt", 3, semihosting::kAppend);
    std::size_t length = 0;
    while (text[length] != '\0')
        ++length;
    semihosting::transfer(semihosting::Call::write, errors, text, length);
}

void print(std::uint32_t number) {
    std::array<char, 11> text{};
    char* digit = &text.back();
    do {
        *--digit = static_cast<char>('0' + number % 10);
        number /= 10;
    } while (number != 0);
    print(digit);
}

[[noreturn]] void end(const char* problem) {
    if (problem != nullptr) print(problem);
    print("stack ");
    print(static_cast<std::uint32_t>(stack::high_water_bytes()));
    print(stack::has_overflown() ? " bytes, overflown\n" : " bytes\n");
    semihosting::exit(problem != nullptr || stack::has_overflown() ? 1 : 0);
}

bool read(void* bytes, std::size_t count) {
    return semihosting::transfer(semihosting::Call::read, camera, bytes, count) == 0;
}

/// Reads a number in an image header, and the character that follows the number.
int read_number() {
    int number = 0;
    for (char byte = '0'; byte >= '0' && byte <= '9';) {
        number = 10 * number + (byte - '0');
        if (!read(&byte, 1)) end("the file ends within a header\n");
    }
    return number;
}

/// Reads the header of the next frame. Ends the program at the end of the file, or if the header is
/// invalid.
board::Frame next_frame() {
    std::array<char, 3> magic;
    if (!read(magic.data(), 1)) end(nullptr);
    if (!read(&magic[1], 2) || magic[0] != 'P' || magic[1] != '5') end("no binary PGM\n");
    width_px = read_number();
    const int height_px = read_number();
    if (read_number() != 255 || width_px > board::kMaxWidth_px)
        end("no frame of 8 bits that there is memory for\n");
    return {width_px, height_px, kFrameTime_us * frames_taken++};
}

}  // namespace

namespace board {

Frame start_frame(std::int64_t not_before_us) {
    for (;;) {
        const Frame frame = next_frame();
        if (frame.time_us >= not_before_us) return frame;
        for (int row = 0; row < frame.height_px; ++row)
            next_row();
    }
}

const std::uint8_t* next_row() {
    filled = 1 - filled;
    auto& row = rows[static_cast<std::size_t>(filled)];
    if (!read(row.data(), static_cast<std::size_t>(width_px)))
        end("the file ends within a frame\n");
    return row.data();
}

void send(const std::uint8_t* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        emulated_uart::put(bytes[i]);
}

}  // namespace board

int run_program(const char* path) {
    std::size_t length = 0;
    while (path[length] != '\0')
        ++length;
    camera = semihosting::open(path, length, semihosting::kRead);
    if (camera < 0) end("cannot open the file of frames\n");
    return run_device();
}

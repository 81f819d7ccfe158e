// Start-up code, which runs the program after a reset and returns to the emulator.
#include <array>
#include <cstdint>

#include "program.hpp"
#include "semihosting.hpp"
#include "stack.hpp"

// These symbols are defined in memory.ld.
extern "C" {
extern std::uint32_t data_begin[], data_end[], data_load[], bss_begin[], bss_end[];
extern void (*const init_array_begin[])();
extern void (*const init_array_end[])();
}

namespace {

void copy(const std::uint32_t* from, volatile std::uint32_t* to, const std::uint32_t* end) {
    while (to < end)
        *to++ = *from++;
}

void clear(volatile std::uint32_t* from, const std::uint32_t* end) {
    while (from < end)
        *from++ = 0;
}

/// Returns the last word of the command line, which is the path of the file of frames.
const char* path_of_frames() {
    static std::array<char, 256> line;
    if (!semihosting::command_line(line.data(), line.size())) return "";
    const char* path = line.data();
    for (const char* at = path; *at != '\0'; ++at) {
        if (*at == ' ') path = at + 1;
    }
    return path;
}

[[noreturn]] void fault() {
    constexpr int kFaultStatus = 99;
    semihosting::exit(kFaultStatus);
}

}  // namespace

extern "C" [[noreturn]] void reset() {
    stack::paint();
    copy(data_load, data_begin, data_end);
    clear(bss_begin, bss_end);
    for (auto* construct = init_array_begin; construct < init_array_end; ++construct)
        (*construct)();
    semihosting::exit(run_program(path_of_frames()));
}

/// The vector table at the start of the flash memory (ARMv6-M Architecture Reference Manual,
/// B1.5.3).
struct Vectors {
    const void* initial_stack;
    std::array<void (*)(), 15> handlers;
};

extern "C" [[gnu::section(".vectors"), gnu::used]] const Vectors vectors{
    stack::stack_top,
    {reset, fault, fault, fault, fault, fault, fault, nullptr, nullptr, nullptr, fault, fault,
     nullptr, fault, fault}};

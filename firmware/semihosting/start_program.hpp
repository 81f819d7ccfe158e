/// Initialises the memory and runs the program. Called by the start-up code, which must already
/// have set up the stack.
#pragma once

#include <array>
#include <cstdint>

#include "program.hpp"
#include "semihosting.hpp"
#include "stack.hpp"

// Symbols defined in memory.ld.
extern "C" {
extern std::uint32_t data_begin[], data_end[], data_load[], bss_begin[], bss_end[];
extern void (*const init_array_begin[])();
extern void (*const init_array_end[])();
}

namespace start {

inline void copy(const std::uint32_t* from, volatile std::uint32_t* to, const std::uint32_t* end) {
    while (to < end)
        *to++ = *from++;
}

inline void clear(volatile std::uint32_t* from, const std::uint32_t* end) {
    while (from < end)
        *from++ = 0;
}

/// Returns the last word of the command line, which is the path of the file with the frames.
/// Returns an empty string if the command line is too long.
inline const char* path_of_frames() {
    static std::array<char, 256> line;
    if (!semihosting::command_line(line.data(), line.size())) return "";
    const char* path = line.data();
    for (const char* at = path; *at != '\0'; ++at) {
        if (*at == ' ') path = at + 1;
    }
    return path;
}

}  // namespace start

[[noreturn, gnu::always_inline]] inline void start_program() {
    stack::paint();
    start::copy(data_load, data_begin, data_end);
    start::clear(bss_begin, bss_end);
    for (auto* construct = init_array_begin; construct < init_array_end; ++construct)
        (*construct)();
    semihosting::exit(run_program(start::path_of_frames()));
}

/// Semihosting calls to a debugger or emulator, as defined in Arm's "Semihosting for AArch32 and
/// AArch64" and adopted by the "RISC-V Semihosting" specification.
#pragma once

#include <cstddef>
#include <cstdint>

namespace semihosting {

enum class Call : std::uint32_t {
    open = 0x01,
    write = 0x05,
    read = 0x06,
    command_line = 0x15,
    exit = 0x20,
};

/// File modes, with the same meanings as in fopen. The file ":tt" is the console: standard output
/// if it is opened for writing, and standard error if it is opened for appending.
inline constexpr std::uint32_t kRead = 1;
inline constexpr std::uint32_t kWrite = 4;
inline constexpr std::uint32_t kAppend = 8;

/// Makes a semihosting call. `arguments` is an array of words whose contents depend on the call.
#ifdef __riscv
inline std::int32_t call(Call number, const void* arguments) {
    register auto a0 asm("a0") = static_cast<std::int32_t>(number);
    register const void* a1 asm("a1") = arguments;
    // The instructions before and after the breakpoint mark it as a semihosting call. The alignment
    // ensures that all three instructions are in the same page.
    asm volatile(
        ".balign 16\n .option push\n .option norvc\n"
        "slli x0, x0, 0x1f\n ebreak\n srai x0, x0, 7\n .option pop"
        : "+r"(a0)
        : "r"(a1)
        : "memory");
    return a0;
}
#else
inline std::int32_t call(Call number, const void* arguments) {
    register auto r0 asm("r0") = static_cast<std::int32_t>(number);
    register const void* r1 asm("r1") = arguments;
    asm volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}
#endif

inline std::uint32_t word(const void* pointer) {
    return reinterpret_cast<std::uint32_t>(pointer);
}

inline std::int32_t open(const char* path, std::size_t length, std::uint32_t mode) {
    const std::uint32_t arguments[] = {word(path), mode, length};
    return call(Call::open, arguments);
}

/// Reads or writes bytes. Returns the number of bytes that were not transferred.
inline std::int32_t transfer(Call number, std::int32_t file, const void* bytes, std::size_t size) {
    const std::uint32_t arguments[] = {static_cast<std::uint32_t>(file), word(bytes), size};
    return call(number, arguments);
}

/// Copies the arguments of the QEMU option `-semihosting-config` to `text`. Returns false if `text`
/// is too small.
inline bool command_line(char* text, std::size_t size) {
    const std::uint32_t arguments[] = {word(text), size};
    return call(Call::command_line, arguments) == 0;
}

[[noreturn]] inline void exit(int status) {
    constexpr std::uint32_t kApplicationExit = 0x20026;
    const std::uint32_t arguments[] = {kApplicationExit, static_cast<std::uint32_t>(status)};
    for (;;)
        call(Call::exit, arguments);
}

}  // namespace semihosting

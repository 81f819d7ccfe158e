/// Linux system calls with the o32 ABI, as provided by QEMU in user mode. The firmware programs use
/// these system calls instead of the peripherals of a board.
#pragma once

#include <cstddef>

namespace linux_o32 {

enum class Call : int { exit = 4001, read = 4003, write = 4004, open = 4005 };

/// Makes a system call. Returns the result, or -1 on failure.
inline int call(Call number, int a, const void* b, std::size_t c) {
    register int v0 asm("$2") = static_cast<int>(number);
    register int a0 asm("$4") = a;
    register const void* a1 asm("$5") = b;
    register std::size_t a2 asm("$6") = c;
    register int failed asm("$7");
    asm volatile("syscall"
                 : "+r"(v0), "=r"(failed)
                 : "r"(a0), "r"(a1), "r"(a2)
                 : "$1", "$3", "$8", "$9", "$10", "$11", "$12", "$13", "$14", "$15", "$24", "$25",
                   "hi", "lo", "memory");
    return failed != 0 ? -1 : v0;
}

[[noreturn]] inline void exit(int status) {
    for (;;)
        call(Call::exit, status, nullptr, 0);
}

}  // namespace linux_o32

// Start-up code, which runs the program after a reset and returns to the emulator.
#include "start_program.hpp"

extern "C" [[noreturn]] void start_on_stack() {
    start_program();
}

/// Where the processor goes after a fault: a multiple of 4, as its register has other uses for the
/// low bits.
extern "C" [[noreturn, gnu::aligned(4)]] void fault() {
    constexpr int kFaultStatus = 99;
    semihosting::exit(kFaultStatus);
}

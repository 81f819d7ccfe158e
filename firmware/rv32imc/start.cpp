// Start-up code. After a reset, runs the program and then returns to the emulator.
#include "start_program.hpp"

extern "C" [[noreturn]] void start_on_stack() {
    start_program();
}

/// Trap handler, aligned to 4 bytes because the two low bits of the trap vector register contain
/// the mode.
extern "C" [[noreturn, gnu::aligned(4)]] void fault() {
    constexpr int kFaultStatus = 99;
    semihosting::exit(kFaultStatus);
}

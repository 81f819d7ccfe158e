// Start-up code. Runs the program and returns to the emulator.
#include "linux.hpp"
#include "program.hpp"
#include "stack.hpp"

// Symbols defined in memory.ld.
extern "C" {
extern void (*const init_array_begin[])();
extern void (*const init_array_end[])();
}

/// Contents of the stack at the start of a process.
struct KernelStack {
    int argument_count;
    const char* arguments[2];
};

extern "C" [[noreturn]] void start_program(const KernelStack& kernel) {
    stack::paint();
    for (auto* construct = init_array_begin; construct < init_array_end; ++construct)
        (*construct)();
    linux_o32::exit(run_program(kernel.argument_count == 2 ? kernel.arguments[1] : ""));
}

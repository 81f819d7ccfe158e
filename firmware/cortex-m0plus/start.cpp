// Start-up code for all Cortex-M targets. After a reset, runs the program and then returns to the
// emulator.
#include <array>
#include <cstdint>

#include "semihosting.hpp"
#include "stack.hpp"
#include "start_program.hpp"

namespace {

[[noreturn]] void fault() {
    constexpr int kFaultStatus = 99;
    semihosting::exit(kFaultStatus);
}

}  // namespace

extern "C" [[noreturn]] void reset() {
#ifdef __ARM_FP
    // The FPU is enabled even for integer programs, because code compiled for an FPU may use its
    // registers for integers.
    *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88) |= 0xFU << 20;
    asm volatile("dsb\n isb" ::: "memory");
#endif
    start_program();
}

/// Vector table at the start of the flash memory (ARMv6-M Architecture Reference Manual, B1.5.3).
struct Vectors {
    const void* initial_stack;
    std::array<void (*)(), 15> handlers;
};

extern "C" [[gnu::section(".vectors"), gnu::used]] const Vectors vectors{
    stack::stack_top,
    {reset, fault, fault, fault, fault, fault, fault, nullptr, nullptr, nullptr, fault, fault,
     nullptr, fault, fault}};

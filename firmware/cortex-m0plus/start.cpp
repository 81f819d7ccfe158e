// Start-up code of all Cortex-M, which runs the program after a reset and returns to the emulator.
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
    // Code for an FPU may use its registers even where it computes with integers only.
    *reinterpret_cast<volatile std::uint32_t*>(0xE000ED88) |= 0xFU << 20;
    asm volatile("dsb\n isb" ::: "memory");
#endif
    start_program();
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

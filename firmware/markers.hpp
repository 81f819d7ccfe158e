/// Markers: no-op instructions that delimit the code measured by firmware/count.cpp.
#pragma once

namespace markers {

#if defined(__thumb__)

inline void resume() {
    asm volatile("mov r10, r10" ::: "memory");
}
inline void pause() {
    asm volatile("mov r11, r11" ::: "memory");
}
inline void end_frame() {
    asm volatile("mov r12, r12" ::: "memory");
}

#elif defined(__mips__)

inline void resume() {
    asm volatile("sltiu $0, $0, 0x1b1" ::: "memory");
}
inline void pause() {
    asm volatile("sltiu $0, $0, 0x1b2" ::: "memory");
}
inline void end_frame() {
    asm volatile("sltiu $0, $0, 0x1b3" ::: "memory");
}

#elif defined(__riscv)

inline void resume() {
    asm volatile("slti x0, x0, 0x1b1" ::: "memory");
}
inline void pause() {
    asm volatile("slti x0, x0, 0x1b2" ::: "memory");
}
inline void end_frame() {
    asm volatile("slti x0, x0, 0x1b3" ::: "memory");
}

#else

inline void resume() {}
inline void pause() {}
inline void end_frame() {}

#endif

}  // namespace markers

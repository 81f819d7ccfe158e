# Toolchain: MIPS32 release 2 without an FPU, as in a PIC32MZ; runs in QEMU's user mode.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR mips32r2)
set(CMAKE_ASM_COMPILER mipsel-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER mipsel-linux-gnu-g++)
# A program needs the linker script; a library compiles without.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)

set(machine "-march=m14k -msoft-float -mno-abicalls -fno-pic -fno-pie -G0")
set(CMAKE_ASM_FLAGS_INIT "${machine}")
# The core runs instructions in order, one a cycle: moved about, they only need more registers and
# jumps.
set(order "-fno-schedule-insns -fno-reorder-blocks")
set(CMAKE_CXX_FLAGS_INIT "${machine} ${order} -isystem ${CMAKE_CURRENT_LIST_DIR}/../firmware/mips32r2/include")
# libgcc is built for an FPU, which its integer functions do not notice.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -no-pie -Wl,--no-warn-mismatch")

set(DOTPOSE_FIRMWARE mips32r2)
# No C library: Debian's wants an FPU. What would need one does not link, or ends in SIGILL.
set(DOTPOSE_FIRMWARE_LIBRARIES -lgcc)

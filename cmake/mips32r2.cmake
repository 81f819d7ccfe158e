# Toolchain: MIPS32 release 2 without an FPU, as in a PIC32MZ; runs in QEMU's user mode.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR mips32r2)
set(CMAKE_ASM_COMPILER mipsel-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER mipsel-linux-gnu-g++)
# A program needs the linker script; a library compiles without.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)

set(firmware ${CMAKE_CURRENT_LIST_DIR}/../firmware/mips32r2)
# microMIPS: the core's shorter instructions, with which the code is a fifth smaller.
set(machine "-march=m14k -mmicromips -msoft-float -mno-abicalls -fno-pic -fno-pie -G0")
set(CMAKE_ASM_FLAGS_INIT "${machine}")
# The core runs instructions in order, one a cycle: moved about, they only need more registers. To
# GCC the costs of a 4Kc are nearer to that than those of a M14K. Divisors are known not to be zero.
set(code "-mtune=4kc -fno-schedule-insns -mno-check-zero-division")
set(CMAKE_CXX_FLAGS_INIT "${machine} ${code} -isystem ${firmware}/include -Wa,${firmware}/stores.s")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -no-pie")

set(DOTPOSE_FIRMWARE mips32r2)
# No library: Debian's are plain MIPS32, for an FPU. What would need one does not link.
set(DOTPOSE_FIRMWARE_LIBRARIES)

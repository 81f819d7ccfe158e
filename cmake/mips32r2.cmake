# Toolchain: MIPS32 release 2 without an FPU, as in a PIC32MZ. Programs run in QEMU's user mode.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR mips32r2)
set(CMAKE_ASM_COMPILER mipsel-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER mipsel-linux-gnu-g++)
# CMake tests the compiler with a library, because a program cannot be linked without the linker
# script.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)

set(firmware ${CMAKE_CURRENT_LIST_DIR}/../firmware/mips32r2)
# microMIPS instructions reduce the code size by a fifth.
set(machine "-march=m14k -mmicromips -msoft-float -mno-abicalls -fno-pic -fno-pie -G0")
set(CMAKE_ASM_FLAGS_INIT "${machine}")
# The processor executes one instruction per cycle, in order. Scheduling would only increase the register
# pressure. GCC's cost model of the 4Kc fits this processor better than the cost model of the M14K. Divisors
# are known to be nonzero, so division by zero is not checked.
set(code "-mtune=4kc -fno-schedule-insns -mno-check-zero-division")
set(CMAKE_CXX_FLAGS_INIT "${machine} ${code} -isystem ${firmware}/include -Wa,${firmware}/stores.s")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -no-pie")

# GCC for MIPS rejects a precompiled header if the optimization level of the source differs
# (firmware/mips32r2/options.cmake), and includes the headers as text. This is not an error.
set(CMAKE_PCH_WARN_INVALID OFF)

set(DOTPOSE_FIRMWARE mips32r2)
# Links no library, because Debian's libraries are plain MIPS32 code that requires an FPU. Programs
# that need a library therefore fail to link.
set(DOTPOSE_FIRMWARE_LIBRARIES)

# Toolchain: Arm Cortex-M0+, no operating system.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m0plus)
set(CMAKE_ASM_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# A program needs the linker script; a library compiles without.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)

set(machine "-mcpu=cortex-m0plus -mthumb -mfloat-abi=soft")
set(CMAKE_ASM_FLAGS_INIT "${machine}")
set(CMAKE_CXX_FLAGS_INIT "${machine}")

set(DOTPOSE_FIRMWARE cortex-m0plus)
# No C library, and so no mathematical function.
set(DOTPOSE_FIRMWARE_LIBRARIES -lgcc)

# Toolchain: Linux on 64-bit Arm, as on a Raspberry Pi.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(tools aarch64-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/linux.cmake)

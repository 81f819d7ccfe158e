# Toolchain: Linux on 32-bit Arm with an FPU.
set(CMAKE_SYSTEM_PROCESSOR arm)
set(tools arm-linux-gnueabihf)
include(${CMAKE_CURRENT_LIST_DIR}/linux.cmake)

# Toolchain: 32-bit RISC-V, as in an ESP32-C3, no operating system.
set(DOTPOSE_FIRMWARE rv32imc)
set(machine "-march=rv32imc -mabi=ilp32 --specs=picolibc.specs")
set(tools riscv64-unknown-elf)
include(${CMAKE_CURRENT_LIST_DIR}/bare-metal.cmake)
# Debian has no C++ library for bare-metal RISC-V, so the build uses the headers of the Arm library.
# The headers that the core includes depend only on the compiler.
file(GLOB arm_headers /usr/include/newlib/c++/*)
set(CMAKE_CXX_FLAGS_INIT
    "${machine} -nostdinc++ -isystem ${arm_headers} -isystem ${arm_headers}/arm-none-eabi")

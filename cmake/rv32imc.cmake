# Toolchain: RISC-V of 32 bits, as in an ESP32-C3, no operating system.
set(DOTPOSE_FIRMWARE rv32imc)
set(machine "-march=rv32imc -mabi=ilp32 --specs=picolibc.specs")
set(tools riscv64-unknown-elf)
include(${CMAKE_CURRENT_LIST_DIR}/bare-metal.cmake)
# Debian has no C++ library for bare RISC-V. The headers of the Arm one serve: what the core includes
# of them depends on the compiler alone.
file(GLOB arm_headers /usr/include/newlib/c++/*)
set(CMAKE_CXX_FLAGS_INIT
    "${machine} -nostdinc++ -isystem ${arm_headers} -isystem ${arm_headers}/arm-none-eabi")

# Toolchain: Arm Cortex-M0+, no operating system.
set(DOTPOSE_FIRMWARE cortex-m0plus)
set(machine "-mcpu=cortex-m0plus -mthumb -mfloat-abi=soft")
set(tools arm-none-eabi)
include(${CMAKE_CURRENT_LIST_DIR}/bare-metal.cmake)

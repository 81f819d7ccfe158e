# Toolchain: Arm Cortex-M4 with an FPU, no operating system.
set(DOTPOSE_FIRMWARE cortex-m4f)
set(machine "-mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard")
set(tools arm-none-eabi)
include(${CMAKE_CURRENT_LIST_DIR}/bare-metal.cmake)

# Toolchain: Arm Cortex-M33, without its optional FPU and without an operating system.
set(DOTPOSE_FIRMWARE cortex-m33)
set(machine "-mcpu=cortex-m33 -mthumb -mfloat-abi=soft")
set(tools arm-none-eabi)
include(${CMAKE_CURRENT_LIST_DIR}/bare-metal.cmake)
# Flash and RAM of QEMU's board mps2-an505, which starts in the secure state.
set(DOTPOSE_FIRMWARE_LINK_OPTIONS -Wl,--defsym=flash_begin=0x10000000 -Wl,--defsym=ram_begin=0x38000000)

# What the toolchains of devices without an operating system share: DOTPOSE_FIRMWARE names the target,
# `machine` has its compiler options, and `tools` is what the names of its compilers begin with.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR ${DOTPOSE_FIRMWARE})
set(CMAKE_ASM_COMPILER ${tools}-gcc)
set(CMAKE_CXX_COMPILER ${tools}-g++)
# A program needs the linker script; a library compiles without.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)

set(CMAKE_ASM_FLAGS_INIT "${machine}")
set(CMAKE_CXX_FLAGS_INIT "${machine}")

# No C library, and so no mathematical function.
set(DOTPOSE_FIRMWARE_LIBRARIES -lgcc)

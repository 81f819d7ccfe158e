# Settings shared by the toolchains for devices without an operating system. DOTPOSE_FIRMWARE is the name of
# the target, `machine` contains its compiler options, and `tools` is the prefix of its compilers.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR ${DOTPOSE_FIRMWARE})
set(CMAKE_ASM_COMPILER ${tools}-gcc)
set(CMAKE_CXX_COMPILER ${tools}-g++)
# CMake tests the compiler with a library, because a program cannot be linked without the linker
# script.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)

set(CMAKE_ASM_FLAGS_INIT "${machine}")
set(CMAKE_CXX_FLAGS_INIT "${machine}")

# There is no C library, and therefore there are no mathematical functions.
set(DOTPOSE_FIRMWARE_LIBRARIES -lgcc)

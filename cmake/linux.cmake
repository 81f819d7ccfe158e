# Settings shared by the toolchains for Linux on other processors. Debian's cross compilers compile the
# programs, and QEMU's user mode runs them. `tools` is the prefix of the compilers, and CMAKE_SYSTEM_PROCESSOR
# is the name of the processor in QEMU.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${tools}-gcc)
set(CMAKE_CXX_COMPILER ${tools}-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${CMAKE_SYSTEM_PROCESSOR} -L /usr/${tools})
# Libraries of the host must not be linked.
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)

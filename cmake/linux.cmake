# Settings shared by the toolchains of Linux on other processors. Debian's cross compilers compile, and QEMU's
# user mode runs the programs. `tools` is the prefix of the compilers, CMAKE_SYSTEM_PROCESSOR the name of the
# processor in QEMU.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${tools}-gcc)
set(CMAKE_CXX_COMPILER ${tools}-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${CMAKE_SYSTEM_PROCESSOR} -L /usr/${tools})
# Libraries of the host cannot be linked.
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE NEVER)

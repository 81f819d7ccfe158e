# Toolchain: Linux on IBM Z, a big-endian processor. Tests whether the code depends on the byte order.
set(CMAKE_SYSTEM_PROCESSOR s390x)
set(tools s390x-linux-gnu)
include(${CMAKE_CURRENT_LIST_DIR}/linux.cmake)

# Toolchain: WebAssembly, by Debian's emscripten.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)

option(DOTPOSE_WASM_SIMD "Use vectors of 16 bytes, which browsers have since about 2022" OFF)
if(DOTPOSE_WASM_SIMD)
    set(CMAKE_CXX_FLAGS_INIT "-msimd128")
endif()

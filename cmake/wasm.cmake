# Toolchain: WebAssembly, with Debian's emscripten.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)

# With -Oz, emscripten disables inlining by default, which makes modules a tenth larger.
set(CMAKE_CXX_FLAGS_INIT "-sINLINING_LIMIT=0")

option(DOTPOSE_WASM_SIMD "Use vectors of 16 bytes, which browsers have since about 2022" OFF)
if(DOTPOSE_WASM_SIMD)
    # Every engine that supports vectors also supports the other extensions, which were introduced
    # one to three years earlier.
    string(APPEND CMAKE_CXX_FLAGS_INIT " -msimd128 -mbulk-memory -msign-ext -mnontrapping-fptoint")
endif()

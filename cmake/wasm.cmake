# Toolchain: WebAssembly, by Debian's emscripten.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)

# With -Oz, emscripten has no function inlined unless told so, which makes modules larger by a tenth.
set(CMAKE_CXX_FLAGS_INIT "-sINLINING_LIMIT=0")

option(DOTPOSE_WASM_SIMD "Use vectors of 16 bytes, which browsers have since about 2022" OFF)
if(DOTPOSE_WASM_SIMD)
    # Whoever has vectors has the other instructions, too; they came one to three years before.
    string(APPEND CMAKE_CXX_FLAGS_INIT " -msimd128 -mbulk-memory -msign-ext -mnontrapping-fptoint")
endif()

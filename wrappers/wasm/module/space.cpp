// Runtime functions of the module dotpose-space.wasm, which is the core with poses in space. No
// function throws, because JavaScript checks all arguments. An exception would end the instance
// with a trap.
#include <cstddef>
#include <cstdint>
#include <new>
#include <typeinfo>

extern "C" {

void* __cxa_allocate_exception(std::size_t size_bytes) noexcept {
    return ::operator new(size_bytes);
}
[[noreturn]] void __cxa_throw(void*, std::type_info*, void (*)(void*)) {
    __builtin_trap();
}

// Called by abort. There is no process that could exit, so the instance ends with a trap.
void __wasi_proc_exit(std::uint32_t) {
    __builtin_trap();
}

// Called when the memory has grown. Does nothing, because the loader recreates its views after each
// call. Without this definition, the module would import the function.
void emscripten_notify_memory_growth(std::size_t) {}

}  // extern "C"

// The runtime of the module dotpose-space.wasm, which is the core with poses in space. JavaScript
// checks all arguments, so no function throws. An exception would end the instance with a trap.
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

// Called when the memory has grown. The loader recreates its views after each call. The function
// exists only to avoid an import.
void emscripten_notify_memory_growth(std::size_t) {}

}  // extern "C"

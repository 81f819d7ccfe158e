// Runtime functions of the dotpose-space.wasm module: the core with poses in space and print maps.
// JavaScript checks all arguments except the contents of print maps. A function that fails sets the
// message returned by `dotpose_space_error` and ends the instance with a trap, as in tools.cpp.
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <typeinfo>

namespace {

const char* error_text = "";

}  // namespace

extern "C" {

// Called by `throw`. All exceptions thrown in this module have std::exception as their first base
// class.
void* __cxa_allocate_exception(std::size_t size_bytes) noexcept {
    return ::operator new(size_bytes);
}
[[noreturn]] void __cxa_throw(void* thrown, std::type_info*, void (*)(void*)) {
    error_text = static_cast<const std::exception*>(thrown)->what();
    __builtin_trap();
}

// Called by abort. There is no process that could exit, so the instance ends with a trap.
void __wasi_proc_exit(std::uint32_t) {
    __builtin_trap();
}

// Called when the memory has grown. Does nothing, because the loader recreates its views after each
// call. Without this definition, the module would import the function.
void emscripten_notify_memory_growth(std::size_t) {}

/// Returns the message of the error that ended the instance, or "" if there was no error.
const char* dotpose_space_error() {
    return error_text;
}

}  // extern "C"

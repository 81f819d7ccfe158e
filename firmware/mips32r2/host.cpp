#include "host.hpp"

#include <cstdint>
#include <cstring>

#include "linux.hpp"

namespace host {
namespace {

using linux_o32::Call;

int input = -1;

}  // namespace

bool open(const char* path) {
    // The first argument of the system call is a pointer to the path, which `call` takes as an int.
    input = linux_o32::call(Call::open, static_cast<int>(reinterpret_cast<std::intptr_t>(path)),
                            nullptr, 0);
    return input >= 0;
}

bool read(void* bytes, std::size_t size) {
    auto* to = static_cast<char*>(bytes);
    while (size > 0) {
        const int taken = linux_o32::call(Call::read, input, to, size);
        if (taken <= 0) return false;
        to += taken;
        size -= static_cast<std::size_t>(taken);
    }
    return true;
}

void print(const char* text) {
    constexpr int kStandardOutput = 1;
    linux_o32::call(Call::write, kStandardOutput, text, std::strlen(text));
}

}  // namespace host

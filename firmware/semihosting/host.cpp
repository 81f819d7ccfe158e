#include "host.hpp"

#include <cstring>

#include "semihosting.hpp"

namespace host {
namespace {

std::int32_t input = -1;

}  // namespace

bool open(const char* path) {
    input = semihosting::open(path, std::strlen(path), semihosting::kRead);
    return input >= 0;
}

bool read(void* bytes, std::size_t size) {
    return semihosting::transfer(semihosting::Call::read, input, bytes, size) == 0;
}

void print(const char* text) {
    static const std::int32_t console = semihosting::open(":tt", 3, semihosting::kWrite);
    semihosting::transfer(semihosting::Call::write, console, text, std::strlen(text));
}

}  // namespace host

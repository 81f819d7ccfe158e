// The firmware as a desktop program: its lines are what the devices must print.
#include <cstdio>

#include "host.hpp"
#include "locate_frames.hpp"

namespace host {
namespace {

std::FILE* input = nullptr;

}  // namespace

bool open(const char* path) {
    input = std::fopen(path, "rb");
    return input != nullptr;
}

bool read(void* bytes, std::size_t size) {
    return std::fread(bytes, 1, size, input) == size;
}

void print(const char* text) {
    std::fputs(text, stdout);
}

}  // namespace host

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: dotpose_frames FRAMES (binary PGM images, one after the other)\n",
                   stderr);
        return 2;
    }
    return locate_frames(argv[1]);
}

/// Files in memory, for functions that read files.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace dotpose::fuzz {

/// A file in memory. The fuzzer exits with an error if the system does not support in-memory files.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(memfd_create("fuzzed", 0)) {
        if (descriptor_ < 0) std::perror("memfd_create"), std::exit(2);
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    void set(const std::uint8_t* data, std::size_t size) {
        const auto count = static_cast<ssize_t>(size);
        if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, data, size, 0) != count) {
            std::perror("write"), std::exit(2);
        }
    }
    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

}  // namespace dotpose::fuzz

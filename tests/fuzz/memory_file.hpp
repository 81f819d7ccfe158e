/// Files for what reads files, without a disk.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace dotpose::fuzz {

/// A file that lives in memory; where the system has none of these, the fuzzer ends.
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

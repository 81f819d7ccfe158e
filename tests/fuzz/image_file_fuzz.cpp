// Any file: `read_image` gives an image or throws Error.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "dotpose/image_file.hpp"

namespace {

using namespace dotpose;

/// A file that lives in memory; where the system has none of these, the fuzzer ends.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(memfd_create("image", 0)) {
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

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    // A few bytes may announce images of gigabytes, which are refused by size only: keep them off,
    // or the fuzzer takes the memory that they need for a fault.
    return setenv("MAGICK_LIMIT_MEMORY", "64MB", 1);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static MemoryFile file;
    file.set(data, size);
    try {
        const GreyImage image = read_image(file.path());
        const bool is_whole = image.width_px > 0 && image.height_px > 0 &&
                              image.width_px <= kMaxImageSide_px &&
                              image.height_px <= kMaxImageSide_px &&
                              image.pixels.size() == static_cast<std::size_t>(image.width_px) *
                                                         static_cast<std::size_t>(image.height_px);
        if (!is_whole) std::abort();
    } catch (const Error& error) {
        if (std::string(error.what()).empty()) std::abort();
    }
    return 0;
}

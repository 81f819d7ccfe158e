// Fuzzes `read_image` and `read_origin` with arbitrary files. They must return an image and its
// origin, or throw Error.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "dotpose/tools/image_file.hpp"
#include "memory_file.hpp"

using namespace dotpose;

// Limits the size of the images. A header of a few bytes can declare an image of several gigabytes,
// and the fuzzer would report the allocation as an error.
constexpr int kMaxPixels = 1 << 20;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static fuzz::MemoryFile file;
    file.set(data, size);
    try {
        const GreyImage image = read_image(file.path(), kMaxPixels);
        const bool is_whole = image.width_px > 0 && image.height_px > 0 &&
                              image.pixels.size() <= kMaxPixels &&
                              image.pixels.size() == static_cast<std::size_t>(image.width_px) *
                                                         static_cast<std::size_t>(image.height_px);
        if (!is_whole) std::abort();
        const ImageOrigin origin = read_origin(file.path());
        if (origin.is_photo && origin.resolution) std::abort();
    } catch (const Error& error) {
        if (std::string(error.what()).empty()) std::abort();
    }
    return 0;
}

// Measures how long the C++ library takes to locate the golden frames (wrappers/golden/README.md)
// without AVX2. For each frame, prints a line with two times in µs: the time for the frame without
// a prediction, and the time for the next frame with a prediction.
//
//   dotpose_wasm_time FILE.frames...
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/kernels/select.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::core {

// Replaces the library function, which would select the AVX2 kernels.
const Kernels& kernels() {
    return wide_kernels();
}

}  // namespace dotpose::core

namespace {

using namespace dotpose;

std::vector<GreyImage> images_of(const char* path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<GreyImage> images;
    GreyImage image;
    std::string magic;
    int greatest = 0;
    while (file >> magic >> image.width_px >> image.height_px >> greatest) {
        file.get();
        image.pixels.resize(static_cast<std::size_t>(image.width_px) *
                            static_cast<std::size_t>(image.height_px));
        file.read(reinterpret_cast<char*>(image.pixels.data()),
                  static_cast<std::streamsize>(image.pixels.size()));
        images.push_back(image);
    }
    return images;
}

template <typename Call>
Fix timed(double& took_us, const Call& call) {
    const auto start = std::chrono::steady_clock::now();
    const Fix fix = call();
    took_us =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    return fix;
}

/// Locates the first frame of each pair, and then the second frame with a prediction from the first
/// fix.
void measure(Locator& locator, const std::vector<GreyImage>& images, bool prints) {
    for (std::size_t i = 0; i + 1 < images.size(); i += 2) {
        const ImageView image = images[i].view();
        const ImageView next = images[i + 1].view();
        double alone_us = 0;
        double tracked_us = 0;
        const Fix fix = timed(alone_us, [&] { return locator.locate(image); });
        if (fix.status == Status::ok) {
            const Prediction prediction = Prediction::like(fix);
            (void)timed(tracked_us, [&] { return locator.locate(next, prediction); });
        }
        if (prints) std::printf("%.2f %.2f\n", alone_us, tracked_us);
    }
}

}  // namespace

int main(int argc, char** argv) {
    Locator locator{DeviceOptions{}};
    for (int i = 1; i < argc; ++i) {
        const std::vector<GreyImage> images = images_of(argv[i]);
        if (images.empty()) return 1;
        measure(locator, images, false);  // warms up the caches
        measure(locator, images, true);
    }
}

// Fuzzes `read_camera` with arbitrary files. It must return a camera that is valid for `locate`, or
// throw Error.
#include <cstdlib>

#include "dotpose/files/camera_file.hpp"
#include "reads_or_refuses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dotpose;
    return fuzz::reads_or_refuses(data, size, [](const std::string& path) {
        const Camera camera = read_camera(path);
        if (camera.width_px < 1 || camera.height_px < 1) std::abort();
        DeviceOptions options;
        use_camera(camera, camera.width_px, camera.height_px, options);
    });
}

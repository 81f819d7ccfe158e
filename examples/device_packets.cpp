// Runs a microcontroller program on a desktop. The program processes each image row by row, as if
// the rows came from a camera, and writes each pose as a 32-byte packet.
//
//     dotpose_device_packets frames/*.pgm > packets.bin
//     dotpose listen packets.bin
#include <cstdint>
#include <cstdio>
#include <exception>

#include <dotpose/locate.hpp>
#include <dotpose/pose_packet.hpp>
#include <dotpose/tools/image_file.hpp>

namespace {

constexpr std::uint32_t kFrameTime_us = 20'000;

// All the memory that the locator uses: 13 KB. The locator allocates nothing on the heap.
dotpose::DeviceMemory memory;

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 2) return std::fputs("usage: device_packets IMAGE...\n", stderr), 2;
    dotpose::DeviceLocator locator(memory);
    for (int i = 1; i < argc; ++i) {
        const dotpose::GreyImage image = dotpose::read_image(argv[i]);
        // The status is ignored, because `finish` reports the same error.
        static_cast<void>(locator.begin(image.width_px, image.height_px));
        for (int row = 0; row < image.height_px; ++row)
            locator.push_row(image.view().row(row));
        const auto sequence = static_cast<std::uint16_t>(i - 1);
        const dotpose::PacketBytes bytes = dotpose::encode(dotpose::make_packet(
            locator.finish(), locator.options().code, sequence, sequence * kFrameTime_us));
        std::fwrite(bytes.data(), 1, bytes.size(), stdout);
    }
} catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 1;
}

// A C++ program that uses only the exported folder. It locates a uniform frame, which shows no
// dots. The receiver of the packet must get the `no_contrast` status.
#include <cstdint>
#include <cstdio>

#include <dotpose_device.hpp>

namespace {

using namespace dotpose;

/// Locates a uniform frame with a locator whose memory is exactly large enough for this frame size.
template <int Width, int Height>
Fix locate_black() {
    static DeviceMemoryFor<Width, Height> memory;
    static DeviceLocator locator(memory);
    static const std::uint8_t row[Width] = {};
    if (locator.begin(Width, Height) != Status::ok) return {};
    for (int v = 0; v < Height; ++v)
        locator.push_row(row);
    return locator.finish();
}

}  // namespace

int main() {
    const Fix fix = locate_black<188, 120>();
    if (fix.status != Status::no_contrast) return 1;
    if (locate_black<160, 120>().status != Status::no_contrast) return 2;
    if (locate_black<320, 240>().status != Status::no_contrast) return 6;

    Tracker tracker;
    if (!tracker.update(20'000, nullptr).is_lost) return 3;
    FramePacer pacer;
    if (pacer.next_frame_us(fix, 20'000) < 20'000) return 4;

    PacketReader reader;
    bool has_come = false;
    for (const std::uint8_t byte : encode(make_packet(fix, CodeVariant::anoto, 7, 20'000)))
        has_come = reader.push(byte);
    if (!has_come || reader.packet().sequence != 7) return 5;
    std::puts(message(reader.packet().status));
}

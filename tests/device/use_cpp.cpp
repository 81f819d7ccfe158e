// A program with nothing but the exported folder, in C++: a white frame shows no dots, and its
// packet says so at the other end.
#include <cstdint>
#include <cstdio>

#include <dotpose_device.hpp>

int main() {
    using namespace dotpose;
    static DeviceMemory memory;
    static DeviceLocator locator(memory);
    static const std::uint8_t row[188] = {};
    if (locator.begin(188, 120) != Status::ok) return 1;
    for (int v = 0; v < 120; ++v)
        locator.push_row(row);
    const Fix fix = locator.finish();
    if (fix.status != Status::no_contrast) return 2;

    Tracker tracker;
    if (!tracker.update(20'000, nullptr).is_lost) return 3;
    FramePacer pacer;
    if (pacer.next_frame_us(fix, 20'000) < 20'000) return 4;

    PacketReader reader;
    bool has_come = false;
    for (const std::uint8_t byte : encode(make_packet(fix, Profile::anoto, 7, 20'000)))
        has_come = reader.push(byte);
    if (!has_come || reader.packet().sequence != 7) return 5;
    std::puts(message(reader.packet().status));
}

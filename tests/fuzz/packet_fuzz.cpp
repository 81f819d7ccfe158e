// Fuzzes the packet reader with arbitrary bytes. Each decoded packet must contain valid values, and
// must not change when it is encoded and decoded again.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "dotpose/pose_packet.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dotpose;
    PacketReader reader;
    for (std::size_t i = 0; i < size; ++i) {
        if (!reader.push(data[i])) continue;
        const PosePacket& packet = reader.packet();
        const auto number = static_cast<int>(packet.status);
        if (number >= kStatusCount && packet.status != Status::other) std::abort();
        if (packet.status == Status::ok &&
            (packet.cell.x >= kPositionsPerAxis || packet.cell.y >= kPositionsPerAxis ||
             packet.section.u >= kSections || packet.section.v >= kSections)) {
            std::abort();
        }
        const PacketBytes again = encode(packet);
        PacketReader second;
        const auto push = [&second](std::uint8_t byte) { return second.push(byte); };
        if (!std::ranges::any_of(again, push) || !(second.packet() == packet)) std::abort();
    }
    return 0;
}

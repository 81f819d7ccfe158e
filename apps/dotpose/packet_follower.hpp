/// Tracks a robot, using the pose packets that a device on the robot sends.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/track.hpp"
#include "reading.hpp"

namespace dotpose::cli {

/// Returns the number of packets from `earlier` to `later`, two sequence numbers that wrap around.
/// The result is 0 if the packet `later` is a repetition, and negative if it arrived late.
inline int packets_since(std::uint16_t earlier, std::uint16_t later) {
    return static_cast<std::int16_t>(later - earlier);
}

/// Returns true if a packet is a repetition or arrived late. `packets` is the result of
/// `packets_since` for the newest packet and this packet. A value below -16 indicates that the
/// device was restarted, so the packet is not considered late.
inline bool is_late(int packets) {
    constexpr int kMaxLate = 16;
    return packets <= 0 && packets >= -kMaxLate;
}

class PacketFollower {
  public:
    /// `spacing_mm` is the spacing of the pattern. If there are sheets, the poses are computed with
    /// the spacings of the sheets, and only the tracker uses `spacing_mm`. The robot is tracked in
    /// the world if any sheet has a world pose, and in the pattern frame otherwise.
    PacketFollower(std::vector<SheetEntry> sheets, double spacing_mm);

    bool has_sheets() const { return !sheets_.empty(); }

    /// Returns the record for a packet, including the place of the fix on the sheets.
    Record record_of(const PosePacket& packet) const;

    /// Updates the track. Returns nullopt if the packet is a repetition or arrived late (see
    /// `is_late`). The times of the readings start at 0 and always increase, even when the clock of
    /// the device wraps around or the device is restarted.
    std::optional<Reading> follow(const PosePacket& packet);

  private:
    bool advance(const PosePacket& packet);

    std::vector<SheetEntry> sheets_;
    double spacing_mm_;
    bool is_in_world_;
    Tracker tracker_;
    std::optional<PosePacket> newest_;
    std::int64_t time_us_ = 0;
    std::int64_t readings_ = 0;
};

}  // namespace dotpose::cli

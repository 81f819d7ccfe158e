/// Pose packets: encoding and decoding of what a device sends over a serial line or radio, one
/// packet for each frame. The format is described in docs/pose-packet.md.
///
///     const PacketBytes bytes = encode(make_packet(fix, options.profile, sequence++, time_us));
///     send(bytes.data(), bytes.size());
///
///     PacketReader reader;
///     for (std::uint8_t byte : received) if (reader.push(byte)) use(reader.packet());
///
/// A packet with one to four wrong bits is always refused, and of those damaged more, all but about
/// 1 of 65536; reading goes on with the next packet. No heap, no double, no globals; different
/// objects may be used at the same time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "dotpose/code.hpp"
#include "dotpose/fix.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Version of the format that is written, and the only one that is read.
inline constexpr int kPacketVersion = 1;

/// The result of one frame, as far as a packet carries it. Unless `status` is ok, only the members
/// above `cell` are valid; the rest is sent as zero.
struct PosePacket {
    std::uint16_t sequence = 0;  ///< counts frames; a gap shows lost packets
    std::uint32_t time_us = 0;   ///< time of the frame on the sender's clock; wraps every 71.6
                                 ///< minutes
    Status status = Status::not_run;
    Profile profile = Profile::anoto;

    Cell cell;  ///< as in Fix
    std::uint16_t fraction_x_q16 = 0;
    std::uint16_t fraction_y_q16 = 0;
    std::int16_t theta_bam16 = 0;  ///< 2^15 is half a turn: steps of 0.0055 degrees
    Section section;
    /// The position is wrong with probability at most 2^-certainty; 255 stands for 255 and more.
    std::uint8_t certainty = 0;
    /// The larger standard deviation of x and y in 2^-12 spacing, rounded up; 255 stands for 255
    /// and more.
    std::uint8_t deviation_q12 = 0;

    // Double precision is used only in these functions, which are not part of the embedded object
    // code.
    double x_grid() const { return cell.x + fraction_x_q16 / 65536.0; }
    double y_grid() const { return cell.y + fraction_y_q16 / 65536.0; }
    /// Angle of the image x axis in the pattern frame, in [-pi, pi).
    double theta_rad() const { return theta_bam16 * (std::numbers::pi / 32768.0); }

    friend constexpr bool operator==(const PosePacket&, const PosePacket&) = default;
};

/// Returns the packet of a fix. `sequence` counts frames; `time_us` is the time of the frame.
PosePacket make_packet(const Fix& fix, Profile profile, std::uint16_t sequence,
                       std::uint32_t time_us);

/// One packet as sent, with its end mark: a zero byte, the only one in it.
using PacketBytes = std::array<std::uint8_t, 32>;

/// Returns the bytes of a packet, ready to be sent.
PacketBytes encode(const PosePacket& packet);

/// Finds packets in a stream of bytes, whatever else is in it.
class PacketReader {
  public:
    /// Takes the next byte and returns whether it completed a packet.
    bool push(std::uint8_t byte);

    /// Returns the newest packet; its content before the first one is not valid.
    const PosePacket& packet() const { return packet_; }

    /// Returns the number of stretches between two end marks that were no packet, because they were
    /// damaged or of another version.
    std::uint32_t damaged() const { return damaged_; }

  private:
    std::array<std::uint8_t, 31> bytes_{};  ///< bytes since the last end mark
    std::size_t count_ = 0;                 ///< number of these bytes; 32 if there were too many
    std::uint32_t damaged_ = 0;
    PosePacket packet_;
};

}  // namespace dotpose

#pragma GCC visibility pop

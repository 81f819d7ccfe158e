/// Pose packets: results that a device sends over a serial line or radio, one packet per frame.
/// docs/pose-packet.md describes the format.
///
///     const PacketBytes bytes = encode(make_packet(fix, options.code, sequence++, time_us));
///     send(bytes.data(), bytes.size());
///
///     PacketReader reader;
///     for (std::uint8_t byte : received) if (reader.push(byte)) use(reader.packet());
///
/// The reader rejects all packets with one to four wrong bits. It accepts about 1 in 65536 packets
/// with five or more wrong bits. After a damaged packet, the reader continues with the next packet.
/// The functions use no heap, no double precision and no global variables. Different objects may be
/// used concurrently.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Supported version of the packet format.
inline constexpr int kPacketVersion = 1;

/// The members of a fix that are sent in a packet. If `status` is not ok, only the members declared
/// before `cell` are valid, and `make_packet` sets the other members to 0.
struct PosePacket {
    std::uint16_t sequence = 0;  ///< frame number (a gap indicates lost packets)
    /// Frame time on the sender's clock, which wraps around every 71.6 minutes.
    std::uint32_t time_us = 0;
    Status status = Status::not_run;
    CodeVariant code = CodeVariant::anoto;

    Cell cell;  ///< as in Fix
    std::uint16_t fraction_x_q16 = 0;
    std::uint16_t fraction_y_q16 = 0;
    /// Binary angle: 2^15 is half a turn, and one step is 0.0055 degrees.
    std::int16_t theta_bam16 = 0;
    Section section;
    /// -log2 of the upper bound on the probability that the position is wrong. 255 means 255 or
    /// more.
    std::uint8_t certainty = 0;
    /// Standard deviation of x or y, whichever is larger, in units of 2^-12 spacings, rounded up.
    /// 255 means 255 or more, or unknown.
    std::uint8_t deviation_q12 = 0;

    // The functions below are inline, because the object code for devices must not use double
    // precision.
    double x_grid() const { return cell.x + fraction_x_q16 / 65536.0; }
    double y_grid() const { return cell.y + fraction_y_q16 / 65536.0; }
    /// Angle of the image x axis in the pattern frame, in [-pi, pi).
    double theta_rad() const { return theta_bam16 * (std::numbers::pi / 32768.0); }

    friend constexpr bool operator==(const PosePacket&, const PosePacket&) = default;
};

/// Returns the packet for a fix. `sequence` is the frame number, and `time_us` is the frame time.
PosePacket make_packet(const Fix& fix, CodeVariant code, std::uint16_t sequence,
                       std::uint32_t time_us);

/// Bytes of a packet, including the end mark. The end mark is the only zero byte.
using PacketBytes = std::array<std::uint8_t, 32>;

/// Encodes a packet for sending.
PacketBytes encode(const PosePacket& packet);

/// Extracts packets from a byte stream that may contain other data.
class PacketReader {
  public:
    /// Processes the next byte. Returns true if the byte completes a valid packet.
    bool push(std::uint8_t byte);

    /// Returns the newest packet. Not valid before the first packet.
    const PosePacket& packet() const { return packet_; }

    /// Returns the number of invalid packets so far. An invalid packet is a byte sequence between
    /// two end marks that is damaged or has an unsupported version.
    std::uint32_t damaged() const { return damaged_; }

  private:
    std::array<std::uint8_t, 31> bytes_{};  ///< bytes since the last end mark
    /// Number of bytes since the last end mark. 32 means 32 or more, which is too long for a
    /// packet.
    std::size_t count_ = 0;
    std::uint32_t damaged_ = 0;
    PosePacket packet_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT

#include "dotpose/pose_packet.hpp"

#include <algorithm>
#include <cmath>

#include "link/framing.hpp"

namespace dotpose {
namespace {

using link::kFramedBytes;
using link::Plain;

static_assert(kFramedBytes + 1 == PacketBytes{}.size(), "a packet is a frame and its end mark");

class Writer {
  public:
    void put(std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            plain_[next_++] = static_cast<std::uint8_t>(value >> (8 * i));
    }
    const Plain& plain() const { return plain_; }

  private:
    Plain plain_{};
    std::size_t next_ = 0;
};

class Reader {
  public:
    explicit Reader(const Plain& plain) : plain_(plain) {}

    std::uint32_t get(int bytes) {
        std::uint32_t value = 0;
        for (int i = 0; i < bytes; ++i)
            value |= std::uint32_t{plain_[next_++]} << (8 * i);
        return value;
    }
    std::uint16_t get16() { return static_cast<std::uint16_t>(get(2)); }
    std::uint8_t get8() { return static_cast<std::uint8_t>(get(1)); }

  private:
    const Plain& plain_;
    std::size_t next_ = 0;
};

/// Writes the fields in the order of the table in docs/pose-packet.md.
Plain packed(const PosePacket& packet) {
    Writer writer;
    writer.put(kPacketVersion, 1);
    writer.put(packet.sequence, 2);
    writer.put(packet.time_us, 4);
    writer.put(static_cast<std::uint32_t>(packet.status), 1);
    writer.put(static_cast<std::uint32_t>(packet.code), 1);
    writer.put(packet.cell.x, 4);
    writer.put(packet.fraction_x_q16, 2);
    writer.put(packet.cell.y, 4);
    writer.put(packet.fraction_y_q16, 2);
    writer.put(static_cast<std::uint16_t>(packet.theta_bam16), 2);
    writer.put(packet.section.u, 1);
    writer.put(packet.section.v, 1);
    writer.put(packet.certainty, 1);
    writer.put(packet.deviation_q12, 1);
    return writer.plain();
}

/// Reads the fields. Returns false if the version is not supported or a field is out of range.
bool unpack(const Plain& plain, PosePacket& packet) {
    Reader reader(plain);
    if (reader.get8() != kPacketVersion) return false;
    PosePacket read;
    read.sequence = reader.get16();
    read.time_us = reader.get(4);
    const std::uint8_t status = reader.get8();
    const std::uint8_t code = reader.get8();
    read.cell.x = reader.get(4);
    read.fraction_x_q16 = reader.get16();
    read.cell.y = reader.get(4);
    read.fraction_y_q16 = reader.get16();
    read.theta_bam16 = static_cast<std::int16_t>(reader.get16());
    read.section = {reader.get8(), reader.get8()};
    read.certainty = reader.get8();
    read.deviation_q12 = reader.get8();
    if (code > static_cast<std::uint8_t>(CodeVariant::microdots) ||
        read.cell.x >= kPositionsPerAxis || read.cell.y >= kPositionsPerAxis ||
        read.section.u >= kSections || read.section.v >= kSections) {
        return false;
    }
    read.status = status < kStatusCount ? static_cast<Status>(status) : Status::other;
    read.code = static_cast<CodeVariant>(code);
    packet = read;
    return true;
}

/// Rounds an angle to the nearest multiple of 2^-16 turn. Half a turn is represented as minus half
/// a turn.
std::int16_t rounded_bam16(std::int32_t theta_bam) {
    const std::uint32_t bits = static_cast<std::uint32_t>(theta_bam) + 0x8000U;
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits >> 16));
}

std::uint8_t deviation_q12(const Fix& fix) {
    const float variance = std::max(fix.covariance[0][0], fix.covariance[1][1]);
    const float deviation = std::sqrt(std::max(variance, 0.0F)) * 4096.0F;
    // 255 means that the standard deviation is unknown (for example, because the fix has no
    // covariance) or too large to encode.
    if (!(deviation > 0) || deviation >= 254) return 255;
    return static_cast<std::uint8_t>(static_cast<int>(deviation) + 1);
}

}  // namespace

PosePacket make_packet(const Fix& fix, CodeVariant code, std::uint16_t sequence,
                       std::uint32_t time_us) {
    PosePacket packet;
    packet.sequence = sequence;
    packet.time_us = time_us;
    packet.status = fix.status;
    packet.code = code;
    if (fix.status != Status::ok) return packet;
    packet.cell = fix.cell;
    packet.fraction_x_q16 = fix.fraction_x_q16;
    packet.fraction_y_q16 = fix.fraction_y_q16;
    packet.theta_bam16 = rounded_bam16(fix.theta_bam);
    packet.section = fix.section;
    packet.certainty = static_cast<std::uint8_t>(std::clamp(-fix.p_wrong_log2, 0, 255));
    packet.deviation_q12 = deviation_q12(fix);
    return packet;
}

PacketBytes encode(const PosePacket& packet) {
    const link::Framed framed = link::frame(packed(packet));
    PacketBytes bytes{};
    std::copy(framed.begin(), framed.end(), bytes.begin());
    return bytes;
}

bool PacketReader::push(std::uint8_t byte) {
    if (byte != 0) {
        if (count_ < bytes_.size()) bytes_[count_] = byte;
        if (count_ <= bytes_.size()) ++count_;
        return false;
    }
    const std::size_t count = count_;
    count_ = 0;
    if (count == 0) return false;  // two consecutive end marks
    Plain plain;
    if (count == bytes_.size() && link::unframe(bytes_, plain) && unpack(plain, packet_)) {
        return true;
    }
    ++damaged_;
    return false;
}

}  // namespace dotpose

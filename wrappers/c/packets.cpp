#include <algorithm>

#include "convert.hpp"
#include "dotpose/pose_packet.hpp"
#include "object.hpp"

namespace {

using namespace dotpose;

using Reader = c::Object<PacketReader, 0xD07C0003>;

static_assert(sizeof(PacketBytes) == DOTPOSE_PACKET_BYTES);

dotpose_packet to_c(const PosePacket& p) {
    return {p.sequence,
            p.time_us,
            static_cast<dotpose_status>(p.status),
            static_cast<std::int32_t>(p.code),
            p.cell.x,
            p.cell.y,
            p.fraction_x_q16,
            p.fraction_y_q16,
            p.theta_bam16,
            p.section.u,
            p.section.v,
            p.certainty,
            p.deviation_q12};
}

/// Reads a packet. Returns BAD_VALUE if a member has a value that a packet cannot contain.
dotpose_status to_core(const dotpose_packet& given, PosePacket& packet) {
    const dotpose_place place{given.cell_x, given.cell_y, given.section_u, given.section_v};
    const bool is_status =
        given.status == DOTPOSE_OTHER || c::is_one_of(given.status, kStatusCount - 1);
    if (given.sequence > UINT16_MAX || !is_status || !c::is_code(given.code) ||
        !c::is_place(place) || given.fraction_x_q16 > UINT16_MAX ||
        given.fraction_y_q16 > UINT16_MAX || given.theta_bam16 < INT16_MIN ||
        given.theta_bam16 > INT16_MAX || given.certainty > UINT8_MAX ||
        given.deviation_q12 > UINT8_MAX) {
        return DOTPOSE_BAD_VALUE;
    }
    packet.sequence = static_cast<std::uint16_t>(given.sequence);
    packet.time_us = given.time_us;
    packet.status = static_cast<Status>(given.status);
    packet.code = static_cast<CodeVariant>(given.code);
    packet.cell = c::to_core(place).cell;
    packet.section = c::to_core(place).section;
    packet.fraction_x_q16 = static_cast<std::uint16_t>(given.fraction_x_q16);
    packet.fraction_y_q16 = static_cast<std::uint16_t>(given.fraction_y_q16);
    packet.theta_bam16 = static_cast<std::int16_t>(given.theta_bam16);
    packet.certainty = static_cast<std::uint8_t>(given.certainty);
    packet.deviation_q12 = static_cast<std::uint8_t>(given.deviation_q12);
    return DOTPOSE_OK;
}

}  // namespace

extern "C" {

dotpose_status dotpose_packet_of(const dotpose_fix* fix, int32_t code, uint32_t sequence,
                                 uint32_t time_us, dotpose_packet* packet) {
    if (packet == nullptr) return DOTPOSE_NULL_POINTER;
    Fix read;
    const dotpose_status status = c::to_core(fix, read);
    if (status != DOTPOSE_OK) return status;
    if (!c::is_code(code)) return DOTPOSE_BAD_VALUE;
    *packet = to_c(make_packet(read, static_cast<CodeVariant>(code),
                               static_cast<std::uint16_t>(sequence), time_us));
    return DOTPOSE_OK;
}

dotpose_status dotpose_packet_encode(const dotpose_packet* packet, uint8_t* bytes,
                                     size_t capacity) {
    if (packet == nullptr || bytes == nullptr) return DOTPOSE_NULL_POINTER;
    if (capacity < DOTPOSE_PACKET_BYTES) return DOTPOSE_TOO_LITTLE_MEMORY;
    PosePacket read;
    const dotpose_status status = to_core(*packet, read);
    if (status != DOTPOSE_OK) return status;
    const PacketBytes encoded = encode(read);
    std::copy(encoded.begin(), encoded.end(), bytes);
    return DOTPOSE_OK;
}

dotpose_status dotpose_packet_reader_init(dotpose_packet_reader* reader) {
    if (reader == nullptr) return DOTPOSE_NULL_POINTER;
    Reader::make(reader);
    return DOTPOSE_OK;
}

dotpose_status dotpose_packet_reader_push(dotpose_packet_reader* reader, uint8_t byte,
                                          dotpose_packet* packet) {
    if (packet == nullptr) return DOTPOSE_NULL_POINTER;
    PacketReader* found = nullptr;
    const dotpose_status status = Reader::find(reader, found);
    if (status != DOTPOSE_OK) return status;
    if (!found->push(byte)) return DOTPOSE_NO_PACKET;
    *packet = to_c(found->packet());
    return DOTPOSE_OK;
}

dotpose_status dotpose_packet_reader_damaged(const dotpose_packet_reader* reader,
                                             uint32_t* damaged) {
    if (damaged == nullptr) return DOTPOSE_NULL_POINTER;
    const PacketReader* found = nullptr;
    const dotpose_status status = Reader::find(reader, found);
    if (status == DOTPOSE_OK) *damaged = found->damaged();
    return status;
}
}

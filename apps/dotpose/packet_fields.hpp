/// Output fields for pose packets.
#pragma once

#include <vector>

#include "dotpose/pose_packet.hpp"
#include "fields.hpp"
#include "pose_fields.hpp"

namespace dotpose::cli {

/// Returns the fields for a packet. `spacing_mm` is the spacing of the pattern. The pose fields are
/// empty if the packet has no fix.
std::vector<Field> fields(const PosePacket& packet, double spacing_mm, Units units);

}  // namespace dotpose::cli

/// Pose packets as fields of output lines.
#pragma once

#include <vector>

#include "dotpose/pose_packet.hpp"
#include "fields.hpp"
#include "pose_fields.hpp"

namespace dotpose::cli {

/// Returns the fields of a packet of a pattern with this spacing. The fields of the pose are empty
/// if the packet has no fix.
std::vector<Field> fields(const PosePacket& packet, double spacing_mm, Units units);

}  // namespace dotpose::cli

// Computes the pose of an AprilTag with libapriltag, for comparison.
#pragma once

#include <optional>

#include "dotpose/tools/simulate.hpp"
#include "space_view.hpp"

namespace dotpose::tables {

/// Renders a shot with a tag of the tag36h11 family instead of the pattern. The tag is centred in
/// the image and has no printing errors. The tag and its white border together are as large as the
/// view permits. Returns the error of the pose that libapriltag computes, or nullopt if libapriltag
/// does not find the tag. libapriltag uses its default options, except that it does not decimate
/// the image. The shot must not have lens distortion.
std::optional<SpaceVector> apriltag_error(const Shot& shot, int id);

}  // namespace dotpose::tables

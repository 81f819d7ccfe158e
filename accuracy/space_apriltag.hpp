// Computes the pose of an AprilTag with libapriltag, for comparison.
#pragma once

#include <optional>

#include "dotpose/tools/simulate.hpp"
#include "space_view.hpp"

namespace dotpose::tables {

/// Renders the view of a shot with a tag of the family tag36h11 instead of the pattern. The centre
/// of the tag is under the image centre. The tag and its white border are as large as the view
/// permits, and are printed without errors. Returns the error of the pose that libapriltag computes
/// with its default options, but without reducing the image. Returns none if libapriltag does not
/// find the tag. The shot must have no lens distortion.
std::optional<SpaceVector> apriltag_error(const Shot& shot, int id);

}  // namespace dotpose::tables

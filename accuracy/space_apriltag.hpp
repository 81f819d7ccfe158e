// Computes the pose of an AprilTag with libapriltag, for comparison.
#pragma once

#include <optional>

#include "dotpose/tools/simulate.hpp"
#include "space_view.hpp"

namespace dotpose::tables {

/// Renders a shot with a tag of the family tag36h11 instead of the pattern. The tag is centred at
/// the image centre, is as large as the view permits including its white border, and has no
/// printing errors. Returns the error of the pose that libapriltag computes with its default
/// options but without decimating the image, or none if libapriltag does not find the tag. The shot
/// must not have lens distortion.
std::optional<SpaceVector> apriltag_error(const Shot& shot, int id);

}  // namespace dotpose::tables

/// Output fields for the pose of a camera in space.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/space_pose.hpp"
#include "dotpose/tools/space_track.hpp"
#include "fields.hpp"
#include "pose_fields.hpp"

namespace dotpose::cli {

/// Returns the fields for a pose in space, including those for the second solution. All field names
/// begin with `camera_`. If `has_sheets` is true, also returns the fields for the pose on the sheet
/// and in the world. If there is no pose, the values are empty.
std::vector<Field> space_fields(const std::optional<SpacePose>& space,
                                const std::optional<SheetPlace>& place, bool has_sheets,
                                Units units);

/// Returns the fields for the track of a camera in space: the verdict, the pose in the pattern
/// frame, the pose in the world (only if `has_sheets` is true), and the velocities. The pose in the
/// pattern frame is empty if `is_in_world` is true, and the pose in the world is empty otherwise.
/// While the camera is lost, only the verdict has a value.
std::vector<Field> space_track_fields(const SpaceTrack& track, bool is_in_world, bool has_sheets,
                                      Units units);

/// Returns true if `Columns::brief` selects the field.
bool is_brief_space_field(const std::string& name);

/// Returns the position and the angles as text, such as "camera x 65.61 ± 0.002 mm, ...".
std::string space_text(const SpacePose& pose, const std::optional<SheetPlace>& place, Units units);

}  // namespace dotpose::cli

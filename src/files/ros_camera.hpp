// Reads camera files in ROS formats.
#pragma once

#include "dotpose/files/camera.hpp"
#include "files/yaml_reader.hpp"

namespace dotpose::files {

/// Returns true if `file` is a camera_info file written by camera_calibration_parsers, or the text
/// form of a camera_info message.
bool is_camera_info(const YamlMap& file);

/// Returns the camera of a camera_info file. Throws Error if the lens cannot be converted, or if a
/// value is missing or out of range. In the latter case, the message contains the key.
Camera camera_from_camera_info(const YamlMap& file);

}  // namespace dotpose::files

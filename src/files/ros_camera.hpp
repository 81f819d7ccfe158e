// Reads camera files in ROS formats.
#pragma once

#include "dotpose/files/camera.hpp"
#include "files/yaml_reader.hpp"

namespace dotpose::files {

/// Returns true if `file` is a camera_info file written by camera_calibration_parsers, or a printed
/// camera_info message.
bool is_camera_info(const YamlMap& file);

/// Returns the camera of a camera_info file. Throws Error if a value is missing or out of range,
/// with the key in the message, or if the lens cannot be converted.
Camera camera_from_camera_info(const YamlMap& file);

}  // namespace dotpose::files

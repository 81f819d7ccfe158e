// Cameras as ROS describes them.
#pragma once

#include "dotpose/files/camera.hpp"
#include "files/yaml_reader.hpp"

namespace dotpose::files {

/// Whether this is a camera_info file: of camera_calibration_parsers, or a printed message.
bool is_camera_info(const YamlMap& file);

/// Throws Error, naming the key.
Camera camera_from_camera_info(const YamlMap& file);

}  // namespace dotpose::files

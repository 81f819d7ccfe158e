/// Values of a camera file that are kept when a calibration replaces the file.
#pragma once

#include <optional>
#include <string>

#include "dotpose/files/camera.hpp"

namespace dotpose::cli {

/// Reads the camera file that a calibration replaces. Returns none if the file is missing or empty.
/// `option` is the option that names the file. Throws Error if the file is not a camera file.
std::optional<Camera> replaced_camera(const std::string& option, const std::string& path);

/// Throws Error if the image sizes of the camera file and of the frames differ.
void require_size(const Camera& file, const Camera& frames, const std::string& path);

/// Copies mount, tip, flat field, readout time, exposure and gain from another calibration of the
/// same camera. Also copies the standard deviations of mount, tip and readout time.
void keep_mount(const Camera& from, Camera& to);

}  // namespace dotpose::cli

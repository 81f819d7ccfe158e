/// Keeps values from an existing camera file when a calibration replaces the file.
#pragma once

#include <optional>
#include <string>

#include "dotpose/files/camera.hpp"

namespace dotpose::cli {

/// Reads the camera file that a calibration is about to replace. Returns nullopt if the file does
/// not exist or is empty. Throws Error if the file is not a camera file. The error message contains
/// `option`, the command-line option that names the file.
std::optional<Camera> replaced_camera(const std::string& option, const std::string& path);

/// Throws Error unless the camera file and the frames have the same image size.
void require_size(const Camera& file, const Camera& frames, const std::string& path);

/// Copies mount, tip, flat field, readout time, exposure and gain from another calibration of the
/// same camera. Also copies the standard deviations of mount, tip and readout time.
void keep_mount(const Camera& from, Camera& to);

}  // namespace dotpose::cli

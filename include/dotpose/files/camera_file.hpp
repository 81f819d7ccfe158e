/// Camera files: reads and writes a `Camera` as YAML.
///
///     const Camera camera = read_camera("camera.yaml");
///     DeviceOptions options;
///     use_camera(camera, image.width_px, image.height_px, options);
///
/// `read_camera` also reads ROS `camera_info` files with the distortion model `plumb_bob`, and
/// converts this model to the distortion model of the paper.
#pragma once

#include <filesystem>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/error.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Version of the camera file format. `read_camera` accepts no other version.
inline constexpr int kCameraFileVersion = 1;

/// Reads a camera file, or a ROS camera_info file. Throws Error, with the file name and the key in
/// the message, in these cases:
/// - The file cannot be read, or has another format or version.
/// - A key is missing, unknown, of the wrong type or out of range.
/// - The distortion model is not plumb_bob, or the paper's equation 2 cannot approximate the lens
///   to within 0.5 px rms.
Camera read_camera(const std::filesystem::path& path);

/// Reads a camera from the text of a camera file or a ROS camera_info file. `name` is the file name
/// used in error messages. Throws Error if the text is not valid (see `read_camera`).
Camera parse_camera(const std::string& text, const std::string& name);

/// Returns true if the file is a ROS camera_info file. Do not write a camera to such a file,
/// because `write_camera` would replace it with a file in another format. Throws Error if the file
/// cannot be read.
bool is_camera_info(const std::filesystem::path& path);

/// Writes a camera file atomically. Throws Error if the file cannot be written, and BadArgument if
/// the camera is not valid (see `validate` in camera.hpp).
void write_camera(const std::filesystem::path& path, const Camera& camera);

}  // namespace dotpose

DOTPOSE_END_EXPORT

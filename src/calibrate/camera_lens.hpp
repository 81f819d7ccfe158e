// Lens of a calibrated camera, in the form that `locate` uses.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/files/camera.hpp"

namespace dotpose::calibrate {

/// Returns the lens of the camera. Throws BadArgument if `locate` does not support the image size
/// of the camera.
inline FixedLens lens_of(const Camera& camera) {
    DeviceOptions options;
    use_camera(camera, camera.width_px, camera.height_px, options);
    return options.lens;
}

}  // namespace dotpose::calibrate

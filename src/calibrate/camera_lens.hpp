// The lens of a calibrated camera, as `locate` takes it.
#pragma once

#include "dotpose/files/camera.hpp"
#include "dotpose/options.hpp"

namespace dotpose::calibrate {

/// Throws BadArgument if the camera's images have no size that `locate` takes.
inline FixedLens lens_of(const Camera& camera) {
    Options options;
    use_camera(camera, camera.width_px, camera.height_px, options);
    return options.lens;
}

}  // namespace dotpose::calibrate

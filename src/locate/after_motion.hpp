// After a motion: the prediction for a frame after the camera moved by a measured motion.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/measured_motion.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// Returns the spacing of the printed grid, in mm.
inline float spacing_mm(const DeviceOptions& options) {
    return static_cast<float>(options.spacing_nm) * 1e-6F;
}

/// Returns the prediction for the frame after `motion`. `last` is the fix of the frame before the
/// motion and must be ok. The spacing in the options must be known.
Prediction after(const MeasuredMotion& motion, const Fix& last, const DeviceOptions& options);

}  // namespace dotpose::core

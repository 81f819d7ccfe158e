// After a motion: predicts the plane in the next frame from the last fix and the measured camera
// motion.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/measured_motion.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::core {

/// Returns the printed grid spacing, in mm.
inline float spacing_mm(const DeviceOptions& options) {
    return static_cast<float>(options.spacing_nm) * 1e-6F;
}

/// Returns the prediction for the frame after `motion`. `last` is the fix before the motion, and
/// must have the status ok. The options must contain the spacing. If the motion is too large to
/// predict, returns the prediction for a camera that has not moved.
Prediction after(const MeasuredMotion& motion, const Fix& last, const DeviceOptions& options);

}  // namespace dotpose::core

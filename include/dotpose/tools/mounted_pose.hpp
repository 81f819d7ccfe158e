/// Mounted pose: the fix of a camera that rides on a robot, whose view of the paper never changes.
///
///     use_camera(camera, image.width_px, image.height_px, options);
///     locator.set_options(options);
///     const Fix seen = locator.locate(image);
///     const Fix fix = with_camera(seen, camera, locator.trace());
#pragma once

#include "dotpose/files/camera.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Refines a fix by the camera file, from the trace of its frame. The view of a mounted camera is
/// always the same, so it is taken from the file, and only place, angle and one scale (sheets are
/// printed differently) are fitted to the dots; this is more exact, above all far from the image
/// centre. Theta becomes the heading of the robot. `print` is the print scale of the sheet that the
/// fix lies on, as far as it is known; the fix stays in terms of the pattern as it was meant to be
/// printed.
Fix with_camera(const Fix& fix, const Camera& camera, const Trace& trace,
                const AxisScale& print = {});

}  // namespace dotpose

#pragma GCC visibility pop

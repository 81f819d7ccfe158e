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

/// Returns the spacing of the pattern as the view of the camera file measures it, in nominal mm:
/// divided by the print scale of the sheet. Not a number without a fix or without such a view.
double measured_spacing_mm(const Fix& fix, const Camera& camera, const AxisScale& print = {});

/// Greatest relative difference between the spacing of a sheet and the measured one. It is larger
/// than the change of scale within the depth of field of a camera close to the paper, and smaller
/// than the 3 % of a page that a printer driver scaled to 97 %.
inline constexpr double kMaxSpacingDifference = 0.025;

/// Whether a measured spacing contradicts that of the sheet. False if one is not a number.
bool contradicts(double measured_mm, double spacing_mm);

}  // namespace dotpose

#pragma GCC visibility pop

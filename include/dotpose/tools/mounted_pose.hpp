/// Mounted pose: the fix of a camera whose view of the paper does not change, for example a camera
/// on a robot.
///
///     use_camera(camera, image.width_px, image.height_px, options);
///     locator.set_options(options);
///     const Fix seen = locator.locate(image);
///     const Fix fix = with_camera(seen, camera, locator.trace());
#pragma once

#include <array>
#include <optional>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/print_map.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Refines a fix, given the camera file and the trace of the frame. The perspective and the nominal
/// scale of a mounted camera are constant and known from the camera file, so only the following
/// parameters are fitted:
/// - the place and the angle,
/// - the ratio of the actual to the nominal scale, because prints differ in scale,
/// - the displacement of the dots, because ink and blur change it,
/// - the velocity and the turn rate, if the camera file contains the readout time of a rolling
///   shutter.
///
/// The result is more accurate than `fix`, especially far from the image centre. The theta of the
/// result is the heading of the robot. `print` is the print scale of the sheet, if it is known. The
/// position in the result is in nominal units of the pattern, like the position in `fix`. If the
/// camera file has no view of the paper, or if the trace has fewer than 12 dots, only theta is
/// changed. A fix that is not ok is returned unchanged.
Fix with_camera(const Fix& fix, const Camera& camera, const Trace& trace,
                const AxisScale& print = {});

/// Velocity of a camera over the paper, estimated from a single rolling-shutter image.
struct ReadoutVelocity {
    /// Velocity of the reference point along x and y of the pattern (y down), in spacings per
    /// second.
    double x_per_s = 0;
    double y_per_s = 0;
    /// Turn rate: the change in theta, in rad per second.
    double turn_rad_s = 0;
    /// Covariance of (x_per_s, y_per_s, turn_rad_s).
    std::array<std::array<double, 3>, 3> covariance{};
};

/// A fix refined by `with_camera`, and the velocity of the camera during the readout. Pose and
/// velocity are fitted together. There is no velocity if there is no fix, if the camera file has no
/// `readout_ms` or no view, or if the trace has fewer than 12 dots.
struct MovingFix {
    Fix fix;
    std::optional<ReadoutVelocity> velocity;
};
MovingFix with_camera_and_velocity(const Fix& fix, const Camera& camera, const Trace& trace,
                                   const AxisScale& print = {});

/// A MovingFix that has been corrected with a map of the print if `map_use` is MapUse::used.
struct MappedMovingFix {
    Fix fix;
    std::optional<ReadoutVelocity> velocity;
    MapUse map_use = MapUse::no_map;
};
/// Variant of `with_camera_and_velocity` that uses measured dot positions from a map of the print
/// instead of the nominal positions. If the map cannot be used, falls back to the nominal
/// positions, and sets `map_use` to the reason. If the camera file has no view of the paper, the
/// fix is corrected as in `with_print_map`.
MappedMovingFix with_camera_and_map(const Fix& fix, const Camera& camera, const Trace& trace,
                                    const AxisScale& print, const PrintMap& map);

/// Returns the spacing of the pattern in nominal mm: the spacing computed from the fix and from the
/// view in the camera file, divided by the print scale of the sheet. Returns NaN if there is no
/// fix, or if the camera file has no view.
double measured_spacing_mm(const Fix& fix, const Camera& camera, const AxisScale& print = {});

/// Maximum relative difference between the nominal and the measured spacing of a sheet. The limit
/// is larger than the scale variation within the depth of field of a camera close to the paper, but
/// smaller than the 3 % by which a printer driver may shrink the page.
inline constexpr double kMaxSpacingDifference = 0.025;

/// Returns true if a measured spacing contradicts the spacing of the sheet. Returns false if either
/// spacing is NaN.
bool contradicts(double measured_mm, double spacing_mm);

}  // namespace dotpose

DOTPOSE_END_EXPORT

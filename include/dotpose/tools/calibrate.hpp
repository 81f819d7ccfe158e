/// Calibration from the sheet itself: every dot's true place is known, so any printed sheet is a
/// calibration target.
///
///     const auto frame_at = [&](int i) { return read_image(names[i]); };
///     const LensCalibration lens = calibrate_lens(20, frame_at, {});
///     write_camera("camera.yaml", lens.camera);
///
/// `calibrate_lens` finds the lens and the scale, `calibrate_spin` and `calibrate_drive` where the
/// camera sits on a robot, `stitch_sheets` how sheets lie beside each other. If the frames cannot
/// determine a result, Error is thrown with advice. Standard deviations are those of one estimate,
/// from the residuals of the fit.
///
/// Frames are requested by their index, several times, and not kept. Functions share no state.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dotpose/files/camera.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/grey_image.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Returns frame `index` of the series, from 0. May throw Error.
using FrameAt = std::function<GreyImage(int index)>;

/// The options that all calibrations share.
struct CalibrateOptions {
    /// The pattern that was printed; only profile and spacing matter. Lengths are true if the
    /// spacing is.
    Pattern pattern;
    /// Whether to find the profile from the frames instead of taking that of `pattern`. Ignored
    /// when stitching, as sheets have their profile.
    bool any_code = false;
    /// Sheets that the frames may show, such as those of a sheet file: the spacing is then that of
    /// the sheet in most frames, as it was printed. Ignored when stitching.
    std::vector<SheetEntry> sheets;
    /// Called after each part of the work; return false to stop (throws Error).
    std::function<bool(int done, int total)> progress;
};

/// Returns the profile, if it is given.
std::optional<Profile> given_code(const CalibrateOptions& options);

/// Number of frames that should be taken; with fewer the verdict is `too_few_frames`.
inline constexpr int kWantedFrames = 5;

/// Whether a lens calibration can be trusted, and if not, why.
enum class CalibrationVerdict {
    good,
    too_few_frames,  ///< under kWantedFrames
    same_place,      ///< all frames show the same dots, whose printing errors look like the lens's
    out_of_focus,    ///< dots are blurred to a third of the spacing
    corners_unseen,  ///< too few dots near the image corners
};
/// Returns the identifier, such as "out_of_focus".
const char* name(CalibrationVerdict verdict);

/// One dot of one frame, with its distance from where the camera's model expects it, in px of the
/// undistorted image.
struct CalibrationDot {
    int frame = 0;      ///< index of the frame
    PixelPoint pixel;   ///< pixel where the dot was seen
    PixelPoint before;  ///< residual of a camera without distortion, skew and tilt
    PixelPoint after;   ///< residual of the calibrated camera
};

/// The calibrated camera, with the evidence for it.
struct LensCalibration {
    Camera camera;
    /// Whether the camera is mounted, so that all frames share height and tilt. If not, it was
    /// moved by hand and each frame has its own; `camera.paper` and `camera.tilt` are then not
    /// known.
    bool is_mounted = true;
    Profile code = Profile::anoto;  ///< profile that was given or found
    double spacing_mm = 0;          ///< spacing that was given, or that of the sheet
    int frames = 0;                 ///< number of frames given
    int located = 0;                ///< different frames of these that have a fix
    int duplicates = 0;             ///< frames that are the same image as an earlier one; left out
    int dots = 0;                   ///< number of dots used
    int outliers = 0;               ///< number of dots left out
    double residual_before_px = 0;  ///< rms per axis, of a camera without distortion, skew and tilt
    double residual_px = 0;         ///< rms per axis
    double px_per_spacing = 0;      ///< mean over the frames, at the image centre
    double dot_width = 0;           ///< width at half depth, in spacings; 1/6 for a sharp dot
    double coverage = 0;            ///< share of the 12 x 8 parts of the image that show dots
    CalibrationVerdict verdict = CalibrationVerdict::good;
    std::string advice;  ///< one or two sentences for the user
    std::vector<CalibrationDot> seen;
};

/// Finds lens and scale and, if the frames determine them, tilt and focal length. Throws Error: no
/// pattern in any frame, a single frame, frames of different sizes, all frames the same image.
LensCalibration calibrate_lens(int frames, const FrameAt& frame_at,
                               const CalibrateOptions& options);

/// Place of the image centre in one frame of a turn on the spot, from the centre of rotation, along
/// the pattern's axes.
struct SpinStation {
    double x_mm = 0;
    double y_mm = 0;
    double theta_rad = 0;
    double off_x_mm = 0;  ///< centre of rotation by this frame alone, minus that by all
    double off_y_mm = 0;
};

/// Whether the calibration of a turn can be trusted, and if not, why.
enum class MountVerdict {
    good,
    drifted,  ///< the robot moved on while it turned, by more than noise explains
};
/// Returns the identifier, such as "drifted".
const char* name(MountVerdict verdict);

/// Where the camera sits: found from the centre of rotation of a robot that turns on the spot.
struct SpinCalibration {
    Camera camera;  ///< the given camera with `reference_px` set
    /// The reference point in mm from the point under the image centre, along the image axes there.
    CameraPoint offset_mm;
    int frames = 0;
    int located = 0;
    double sigma_mm = 0;     ///< standard deviation of the centre of rotation, per axis
    double residual_mm = 0;  ///< rms of the frames about it, per axis: how well the robot stayed on
                             ///< the spot
    double turn_rad = 0;     ///< smallest arc that holds all angles
    /// Error of the centre of rotation, per axis, from a robot that moved on while it turned; part
    /// of `sigma_mm`. 0 if it moved by no more than noise explains.
    double drift_mm = 0;
    MountVerdict verdict = MountVerdict::good;
    std::vector<SpinStation> stations;
};

/// Finds where the camera sits from at least 3 frames over more than 30 degrees; a full turn in 12
/// is good. `camera` gives lens and view; none: a camera without distortion. Throws Error: too few
/// frames with a fix, too small a turn, frames of other sizes, a spacing that contradicts the
/// camera's view, a point farther off than a camera
/// file can say, a centre of rotation that varies by more than one spacing (rms per axis) or is
/// uncertain by more than half a spacing.
SpinCalibration calibrate_spin(int frames, const FrameAt& frame_at,
                               const std::optional<Camera>& camera,
                               const CalibrateOptions& options);

/// The direction in which the camera looks: found from frames of a straight drive forwards, in
/// order.
struct DriveCalibration {
    Camera camera;  ///< the given camera with `theta_offset_rad` set
    int frames = 0;
    int located = 0;
    double sigma_rad = 0;    ///< standard deviation of the offset
    double residual_mm = 0;  ///< rms distance of the places from a straight line
    double length_mm = 0;    ///< length of the drive
};

/// Finds the camera's direction from at least 2 frames over more than 5 mm. Throws Error: too few
/// frames with a fix, frames of other sizes, a spacing that contradicts the camera's view, too
/// short a drive, a robot that turned by more than 5
/// degrees off its mean direction, left the straight line by more than that, or went back.
DriveCalibration calibrate_drive(int frames, const FrameAt& frame_at,
                                 const std::optional<Camera>& camera,
                                 const CalibrateOptions& options);

/// The reference of print scales. Frames show how much longer one sheet was printed than another,
/// and one axis than the other; but no frame shows what a millimetre is.
struct ScaleReference {
    enum class By {
        fixed_sheet,  ///< no measurement: the mean of both print scales of the fixed sheet stays as
                      ///< it is
        camera,       ///< the camera's mm per px are true, as calibrated with a true spacing
        width         ///< the true width of a sheet was measured
    };
    By by = By::fixed_sheet;
    std::string sheet;    ///< name of the sheet whose width was measured
    double width_mm = 0;  ///< measured width, from the first to the last column of intersections
};

/// Standard deviation of a print scale from the sheet file's value, before any frame is seen.
inline constexpr double kUsualPrintError = 0.003;
/// Whether the frames determined a print scale, so that it does not rest on the sheet file alone.
inline constexpr bool is_told(double sigma_scale) {
    return sigma_scale < kUsualPrintError / 2;
}

/// The accuracy of one sheet after stitching.
struct StitchedSheet {
    std::string name;
    double sigma_mm = 0;  ///< standard deviation of its corner's place against the fixed sheet, per
                          ///< axis
    double sigma_rad = 0;  ///< standard deviation of its yaw
    bool is_fixed = false;
    double sigma_scale_x = 0;  ///< standard deviations of its print scales
    double sigma_scale_y = 0;
};
/// Two sheets that some frames show together.
struct Seam {
    std::string first;
    std::string second;
    int frames = 0;
    double residual_mm = 0;   ///< rms over the frames, per axis
    double residual_rad = 0;  ///< rms over the frames
};
/// Place of one frame's image centre on both sheets, each from the sheet's first intersection, in
/// mm as meant to be printed.
struct SeamSighting {
    std::size_t first = 0;  ///< index of the first sheet
    std::size_t second = 0;
    double first_x_mm = 0;
    double first_y_mm = 0;
    double second_x_mm = 0;
    double second_y_mm = 0;
};
/// The sheets laid out in the world, with the evidence for it.
struct Stitching {
    /// The given sheets in order, with the world poses and print scales of those stitched.
    std::vector<SheetEntry> sheets;
    std::vector<StitchedSheet> stitched;
    std::vector<Seam> seams;
    std::vector<SeamSighting> sightings;   ///< sightings of connected sheets
    std::vector<std::string> unconnected;  ///< names of sheets that no seam joins to the fixed one
    int frames = 0;
    int used = 0;              ///< number of frames that show two sheets
    ScaleReference reference;  ///< reference of the print scales
};

/// Finds the world poses of sheets from frames that show parts of two, and how much longer than
/// meant they were printed. Among the sheets seen beside another one, the first with a world pose
/// keeps it; if no sheet has one, the first becomes the world: its corner the origin, its upper
/// edge the x axis. `camera` gives lens and view; without a view, which only mounted cameras have,
/// it is fitted to each part of a frame: places are then less exact, and are right only if the
/// fixed sheet was printed to the scales in the sheet file. Throws Error: no sheets, no frame shows
/// two of them, none of those shown lies in the world though others do, the sheet of the reference
/// is not among those joined, a print scale by the camera that is more than 25 % off; BadArgument:
/// the reference does not exist.
Stitching stitch_sheets(int frames, const FrameAt& frame_at, std::vector<SheetEntry> sheets,
                        const std::optional<Camera>& camera, const CalibrateOptions& options,
                        const ScaleReference& reference = {});

}  // namespace dotpose

#pragma GCC visibility pop

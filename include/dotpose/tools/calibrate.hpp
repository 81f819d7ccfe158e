/// Calibration from the sheet itself: every dot's true place is known, so any printed sheet is a
/// calibration target.
///
///     const auto frame_at = [&](int i) { return read_image(names[i]); };
///     const LensCalibration lens = calibrate_lens(20, frame_at, {});
///     write_camera("camera.yaml", lens.camera);
///
/// `calibrate_lens` finds the lens and the scale, `calibrate_spin` and `calibrate_drive` the mount
/// of the camera on a robot, `stitch_sheets` the relative poses of adjacent sheets. If the frames
/// cannot determine a result, Error is thrown with advice. Standard deviations are computed from
/// the residuals of the fit.
///
/// Frames are requested by index, several times, and not stored. Functions share no state.
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

/// The common options of all calibrations.
struct CalibrateOptions {
    /// The printed pattern; only code variant and spacing are used. Lengths are true if the spacing
    /// is true.
    Pattern pattern;
    /// Whether to detect the code variant from the frames instead of using that of `pattern`.
    /// Ignored when stitching, because sheets have their code variant.
    bool any_code = false;
    /// Sheets that the frames may show, such as those of a sheet file: the spacing is then the
    /// printed spacing of the sheet in most frames. Ignored when stitching.
    std::vector<SheetEntry> sheets;
    /// Called after each part of the work; return false to stop (throws Error).
    std::function<bool(int done, int total)> progress;
};

/// Returns the given code variant; none if it is detected.
std::optional<CodeVariant> given_code(const CalibrateOptions& options);

/// Required number of frames; with fewer the verdict is `too_few_frames`.
inline constexpr int kWantedFrames = 5;

/// Whether a lens calibration is reliable, or the reason why not.
enum class CalibrationVerdict {
    good,
    too_few_frames,  ///< under kWantedFrames
    same_place,      ///< all frames show the same dots, so printing errors look like lens errors
    out_of_focus,    ///< dots are blurred to a third of the spacing
    corners_unseen,  ///< too few dots near the image corners
};
/// Returns the identifier, such as "out_of_focus".
const char* name(CalibrationVerdict verdict);

/// One dot of one frame, with its residuals in px of the undistorted image.
struct CalibrationDot {
    int frame = 0;      ///< index of the frame
    PixelPoint pixel;   ///< measured pixel of the dot
    PixelPoint before;  ///< residual of a camera without distortion, skew and tilt
    PixelPoint after;   ///< residual of the calibrated camera
};

/// The calibrated camera, with the evidence for it.
struct LensCalibration {
    Camera camera;
    /// Whether the camera is mounted and all frames share height and tilt. A hand-held camera has
    /// its own height and tilt in each frame; `camera.paper` and `camera.tilt` are then not known.
    bool is_mounted = true;
    CodeVariant code = CodeVariant::anoto;  ///< given or detected code variant
    double spacing_mm = 0;                  ///< given spacing, or spacing of the sheet
    int frames = 0;                         ///< number of frames given
    int located = 0;                        ///< number of different frames with a fix
    int duplicates = 0;             ///< number of frames that repeat an earlier image; not used
    int dots = 0;                   ///< number of dots used
    int outliers = 0;               ///< number of dots not used
    double residual_before_px = 0;  ///< rms per axis for a camera without distortion, skew and tilt
    double residual_px = 0;         ///< rms per axis
    double px_per_spacing = 0;      ///< mean over the frames, at the image centre
    double dot_width = 0;           ///< width at half depth, in spacings; 1/6 for a sharp dot
    double coverage = 0;            ///< fraction of the 12 x 8 parts of the image that show dots
    CalibrationVerdict verdict = CalibrationVerdict::good;
    std::string advice;  ///< one or two sentences for the user
    std::vector<CalibrationDot> seen;
};

/// Finds lens and scale and, if the frames determine them, tilt and focal length. Throws Error: no
/// pattern in any frame, a single frame, frames of different sizes, all frames the same image.
LensCalibration calibrate_lens(int frames, const FrameAt& frame_at,
                               const CalibrateOptions& options);

/// Position of the image centre in one frame of a turn on the spot, relative to the centre of
/// rotation, along the pattern's axes.
struct SpinStation {
    double x_mm = 0;
    double y_mm = 0;
    double theta_rad = 0;
    double off_x_mm = 0;  ///< centre of rotation from this frame alone minus that from all frames
    double off_y_mm = 0;
};

/// Whether the calibration of a turn is reliable, or the reason why not.
enum class MountVerdict {
    good,
    drifted,  ///< the robot drifted while it turned, by more than noise explains
};
/// Returns the identifier, such as "drifted".
const char* name(MountVerdict verdict);

/// The position of the camera on a robot, from the centre of rotation of a turn on the spot.
struct SpinCalibration {
    Camera camera;  ///< the given camera with `reference_px` set
    /// The reference point in mm from the point under the image centre, along the image axes there.
    CameraPoint offset_mm;
    int frames = 0;
    int located = 0;
    double sigma_mm = 0;     ///< standard deviation of the centre of rotation, per axis
    double residual_mm = 0;  ///< rms of the frames about the centre of rotation, per axis
    double turn_rad = 0;     ///< smallest arc that contains all angles
    /// Error of the centre of rotation, per axis, from a drift of the robot while it turned; part
    /// of `sigma_mm`. 0 if noise explains the drift.
    double drift_mm = 0;
    MountVerdict verdict = MountVerdict::good;
    std::vector<SpinStation> stations;
};

/// Finds the position of the camera on the robot from at least 3 frames over more than 30 degrees;
/// a full turn in 12 frames is recommended. `camera` has lens and view; none means a camera without
/// distortion. Throws Error: too few frames with a fix, too small a turn, frames of other sizes, a
/// spacing that contradicts the camera's view, a reference point beyond the range of a camera file,
/// a centre of rotation that varies by more than one spacing (rms per axis) or is uncertain by more
/// than half a spacing.
SpinCalibration calibrate_spin(int frames, const FrameAt& frame_at,
                               const std::optional<Camera>& camera,
                               const CalibrateOptions& options);

/// The direction of the camera on the robot, from frames of a straight drive forwards, in order.
struct DriveCalibration {
    Camera camera;  ///< the given camera with `theta_offset_rad` set
    int frames = 0;
    int located = 0;
    double sigma_rad = 0;    ///< standard deviation of the offset
    double residual_mm = 0;  ///< rms distance of the positions from a straight line
    double length_mm = 0;    ///< length of the drive
};

/// Finds the camera's direction from at least 2 frames over more than 5 mm. Throws Error: too few
/// frames with a fix, frames of other sizes, a spacing that contradicts the camera's view, too
/// short a drive, or a robot that turned by more than 5 degrees from its mean direction, left the
/// straight line by more than that, or went back.
DriveCalibration calibrate_drive(int frames, const FrameAt& frame_at,
                                 const std::optional<Camera>& camera,
                                 const CalibrateOptions& options);

/// The reference of print scales. Frames determine the ratios between the scales of sheets and
/// axes, but not the length of a millimetre.
struct ScaleReference {
    enum class By {
        fixed_sheet,  ///< no measurement: the mean of both print scales of the fixed sheet does not
                      ///< change
        camera,       ///< the camera's mm per px are true because they were calibrated with a true
                      ///< spacing
        width         ///< the true width of a sheet was measured
    };
    By by = By::fixed_sheet;
    std::string sheet;    ///< name of the sheet whose width was measured
    double width_mm = 0;  ///< measured width, from the first to the last column of intersections
};

/// Prior standard deviation of a print scale, relative to the value in the sheet file.
inline constexpr double kUsualPrintError = 0.003;
/// Whether the frames determined a print scale, beyond the value in the sheet file.
inline constexpr bool is_scale_known(double sigma_scale) {
    return sigma_scale < kUsualPrintError / 2;
}

/// The accuracy of one sheet after stitching.
struct StitchedSheet {
    std::string name;
    double sigma_mm = 0;   ///< standard deviation of the position of its corner relative to the
                           ///< fixed sheet, per axis
    double sigma_rad = 0;  ///< standard deviation of its yaw
    bool is_fixed = false;
    double sigma_scale_x = 0;  ///< standard deviations of its print scales
    double sigma_scale_y = 0;
};
/// Two sheets that appear together in some frames.
struct Seam {
    std::string first;
    std::string second;
    int frames = 0;
    double residual_mm = 0;   ///< rms over the frames, per axis
    double residual_rad = 0;  ///< rms over the frames
};
/// Position of one frame's image centre on both sheets, relative to the first intersection of each
/// sheet, in nominal mm.
struct SeamSighting {
    std::size_t first = 0;  ///< index of the first sheet
    std::size_t second = 0;
    double first_x_mm = 0;
    double first_y_mm = 0;
    double second_x_mm = 0;
    double second_y_mm = 0;
};
/// The world poses of sheets, with their evidence.
struct Stitching {
    /// The given sheets in order; stitched sheets have new world poses and print scales.
    std::vector<SheetEntry> sheets;
    std::vector<StitchedSheet> stitched;
    std::vector<Seam> seams;
    std::vector<SeamSighting> sightings;  ///< sightings of connected sheets
    std::vector<std::string>
        unconnected;  ///< names of sheets without a connection to the fixed sheet
    int frames = 0;
    int used = 0;              ///< number of frames that show two sheets
    ScaleReference reference;  ///< reference of the print scales
};

/// Finds the world poses and print scales of sheets from frames that show parts of two sheets. Of
/// the stitched sheets, the first with a world pose keeps it; if none has one, the first sheet
/// defines the world: its corner is the origin, its upper edge the x axis. `camera` has lens and
/// view. Without a view, which only mounted cameras have, the view is fitted to each part of a
/// frame: poses are then less exact, and correct only if the fixed sheet has the print scales in
/// the sheet file. Throws Error: no sheets; no frame shows two of them; no sheet in view has a
/// world pose although others have; the sheet of the reference is not stitched; a print scale from
/// the camera with an error above 25 %. Throws BadArgument: the reference does not exist.
Stitching stitch_sheets(int frames, const FrameAt& frame_at, std::vector<SheetEntry> sheets,
                        const std::optional<Camera>& camera, const CalibrateOptions& options,
                        const ScaleReference& reference = {});

}  // namespace dotpose

#pragma GCC visibility pop

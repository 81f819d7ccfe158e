/// Calibration with printed sheets. The true position of every dot is known, so any printed sheet
/// can serve as a calibration target.
///
///     const auto frame_at = [&](int i) { return read_image(names[i]); };
///     const LensCalibration lens = calibrate_lens(20, frame_at, {});
///     write_camera("camera.yaml", lens.camera);
///
/// - `calibrate_lens` determines the lens and the scale.
/// - `calibrate_spin` and `calibrate_drive` determine the mount of the camera on a robot.
/// - `calibrate_pivot` determines the tip of a pen that contains the camera.
/// - `calibrate_flat_field` determines the vignetting.
/// - `calibrate_readout` determines the readout time of a rolling shutter.
/// - `stitch_sheets` determines the relative poses of adjacent sheets.
///
/// If the frames are insufficient for a result, the functions throw Error with advice for the user.
/// Standard deviations are computed from the residuals of the fit.
///
/// The functions request frames by index and do not store them. They can request the same frame
/// several times. There is no shared state.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/grey_image.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Returns frame `index` of the series. The first frame has index 0. May throw Error.
using FrameAt = std::function<GreyImage(int index)>;

/// Options common to all calibrations.
struct CalibrateOptions {
    /// The printed pattern. Only its code variant and spacing are used. All measured lengths are
    /// proportional to the spacing, so an error in the spacing causes the same relative error in
    /// these lengths.
    Pattern pattern;
    /// True to detect the code variant from the frames instead of using the code variant of
    /// `pattern`. `stitch_sheets` ignores this option, because each sheet has its own code variant.
    bool any_code = false;
    /// Sheets that the frames may show, for example the sheets of a sheet file. If the list is not
    /// empty, the spacing of `pattern` is ignored. The calibration then uses the printed spacing of
    /// the sheet that appears in the largest number of frames. `stitch_sheets` ignores this option.
    std::vector<SheetEntry> sheets;
    /// Called after each step of the calibration. Returning false aborts the calibration with an
    /// Error.
    std::function<bool(int done, int total)> progress;
};

/// Returns the code variant given in the options, or none if it must be detected from the frames.
std::optional<CodeVariant> given_code(const CalibrateOptions& options);

/// Required number of distinct frames with a fix. With fewer frames, the verdict is
/// `too_few_frames`.
inline constexpr int kWantedFrames = 5;

/// Verdict on a lens calibration: `good`, or the reason why the calibration is not reliable.
enum class CalibrationVerdict {
    good,
    too_few_frames,  ///< fewer than kWantedFrames distinct frames have a fix
    /// All frames show the same dots, so printing errors and lens errors cannot be separated.
    same_place,
    out_of_focus,    ///< the dots are blurred to about a third of the spacing or more
    corners_unseen,  ///< too few parts of the image show dots (see kMinCoverage)
};
/// Returns the identifier, such as "out_of_focus".
const char* name(CalibrationVerdict verdict);

/// One dot in one frame, with its residuals in undistorted px.
struct CalibrationDot {
    int frame = 0;     ///< index of the frame in the series
    PixelPoint pixel;  ///< measured pixel coordinates of the dot
    /// Residual before the calibration, computed with a camera model that has no distortion, skew
    /// or tilt.
    PixelPoint before;
    PixelPoint after;  ///< residual after the calibration
};

/// Result of a lens calibration: the camera, and measures of the reliability of the calibration.
struct LensCalibration {
    Camera camera;
    /// True if the camera is mounted, with the same height and tilt in all frames. If false, the
    /// camera is hand-held: its height and tilt differ between frames, so `camera.paper` and
    /// `camera.tilt` are none.
    bool is_mounted = true;
    CodeVariant code = CodeVariant::anoto;  ///< given or detected code variant
    double spacing_mm = 0;                  ///< given spacing, or spacing of the sheet
    int frames = 0;                         ///< number of input frames
    int located = 0;                        ///< number of distinct frames with a fix
    /// Number of frames that were skipped because they repeat an earlier frame.
    int duplicates = 0;
    int dots = 0;      ///< number of dots used
    int outliers = 0;  ///< number of dots rejected as outliers
    /// Rms residual, per axis, before the calibration, computed with a camera model that has no
    /// distortion, skew or tilt.
    double residual_before_px = 0;
    double residual_px = 0;  ///< rms residual per axis after the calibration
    /// Mean grid spacing at the image centre over all frames, in px.
    double px_per_spacing = 0;
    /// Mean width of the dots at half their darkness, in spacings. Sharp dots have a width of 1/6.
    double dot_width = 0;
    double coverage = 0;  ///< fraction of the parts of the image (see ImageCoverage) that show dots
    CalibrationVerdict verdict = CalibrationVerdict::good;
    std::string advice;  ///< one or two sentences for the user
    std::vector<CalibrationDot> seen;
};

/// Computes the lens and the scale. Also computes the tilt and the focal length if the frames
/// determine them. Throws BadArgument if `frames` is less than 1. Throws Error in these cases:
/// - Fewer than two distinct frames can be located.
/// - The frames differ in size.
/// - `options.sheets` is not empty, but no frame shows one of these sheets.
/// - No plausible lens fits the frames.
LensCalibration calibrate_lens(int frames, const FrameAt& frame_at,
                               const CalibrateOptions& options);

/// Position of the image centre in one frame of a turn on the spot, relative to the centre of
/// rotation. x and y are along the axes of the pattern.
struct SpinStation {
    double x_mm = 0;
    double y_mm = 0;
    double theta_rad = 0;
    /// Centre of rotation computed from this frame alone, minus the centre computed from all
    /// frames.
    double off_x_mm = 0;
    double off_y_mm = 0;
};

/// Verdict on a calibration from a turn on the spot: `good`, or the reason why the calibration is
/// not reliable.
enum class MountVerdict {
    good,
    drifted,  ///< the robot drifted while it turned, by more than noise can explain
};
/// Returns the identifier, such as "drifted".
const char* name(MountVerdict verdict);

/// Position of the camera on a robot, computed from the frames of a turn on the spot. The reference
/// point is the centre of rotation.
struct SpinCalibration {
    Camera camera;  ///< the given camera with `reference_px` set
    /// Reference point relative to the point under the image centre, in mm along the image axes at
    /// that point.
    CameraPoint offset_mm;
    int frames = 0;
    int located = 0;
    double sigma_mm = 0;  ///< standard deviation of the centre of rotation, per axis
    /// Rms difference, per axis, between the measured and the fitted positions of the camera.
    double residual_mm = 0;
    double turn_rad = 0;  ///< angle of the smallest arc that contains the directions of all frames
    /// Error of the centre of rotation, per axis, due to a drift of the robot while it turned.
    /// Included in `sigma_mm`. 0 if noise explains the drift.
    double drift_mm = 0;
    MountVerdict verdict = MountVerdict::good;
    std::vector<SpinStation> stations;
};

/// Computes the position of the camera on the robot from at least 3 frames that cover more than 30
/// degrees. A full turn in 12 frames is recommended. `camera` contains the lens and the view of the
/// paper. Without `camera`, the lens is assumed to have no distortion. Throws Error in these cases:
/// - Too few frames have a fix, or the turn is too small.
/// - The size of a frame differs from the size in the camera file or the size of the first frame.
/// - The spacing of the pattern contradicts the view in the camera file.
/// - The reference point is outside the range permitted in a camera file.
/// - The centre of rotation varies by more than one spacing (rms per axis), or its uncertainty is
///   more than half a spacing.
SpinCalibration calibrate_spin(int frames, const FrameAt& frame_at,
                               const std::optional<Camera>& camera,
                               const CalibrateOptions& options);

/// Direction of the camera on the robot, computed from the frames of a straight forward drive. The
/// frames must be in the order in which they were captured.
struct DriveCalibration {
    Camera camera;  ///< the given camera with `theta_offset_rad` set
    int frames = 0;
    int located = 0;
    double sigma_rad = 0;    ///< standard deviation of `camera.theta_offset_rad`
    double residual_mm = 0;  ///< rms distance of the positions from the fitted straight line
    double length_mm = 0;    ///< length of the drive
};

/// Computes the direction of the camera from at least 2 frames, taken along a drive of more than
/// 5 mm. Throws Error in these cases:
/// - Too few frames have a fix, or the drive is too short.
/// - The size of a frame differs from the size in the camera file or the size of the first frame.
/// - The spacing of the pattern contradicts the view in the camera file.
/// - The robot turned by more than 5 degrees from its mean direction, deviated from a straight line
///   by more than 4.4 % of the length of the drive, or drove backwards.
DriveCalibration calibrate_drive(int frames, const FrameAt& frame_at,
                                 const std::optional<Camera>& camera,
                                 const CalibrateOptions& options);

/// Position of the tip of a pen relative to the camera, computed from frames in which the tip rests
/// on the paper while the pen pivots about the tip.
struct PivotCalibration {
    Camera camera;  ///< the given camera with `tip` set
    int frames = 0;
    int located = 0;
    int used = 0;  ///< number of frames in which the tip is at the common point of rest
    /// Rms angle by which the pen rotated about the axis of least rotation. A larger angle gives a
    /// more accurate tip position.
    double pivot_rad = 0;
    double min_tilt_rad = 0;
    double max_tilt_rad = 0;
    double residual_mm = 0;  ///< rms distance of the tip from the point of rest, per axis
    /// Rms ratio of the actual to the expected error. The actual error is the distance between the
    /// tip and the point of rest. The expected error is the standard deviation of this distance,
    /// computed from the covariances of the poses. If the ratio is above 1, the standard deviations
    /// of the tip are increased accordingly.
    double error_ratio = 0;
};

/// Computes the position of the tip of a pen that contains the camera, from at least 6 frames. The
/// tip must rest at one point on a sheet while the pen is tilted by 0 to 40 degrees in several
/// directions. 30 frames are recommended. Frames in which the tip is elsewhere are not used.
/// `camera` must contain the focal length. Writes the standard deviations to `Camera::sigma`.
/// Throws Error in these cases:
/// - Too few frames have a pose in space.
/// - The size of a frame differs from the size in the camera file.
/// - The pen does not pivot enough, or only about one axis.
/// - The tip did not rest at one point: more than a third of the frames contradict the others, or
///   the tip moved by more than half a spacing (rms per axis).
/// - The standard deviation of the tip position exceeds half a spacing.
///
/// Throws BadArgument if the camera file has no focal length.
PivotCalibration calibrate_pivot(int frames, const FrameAt& frame_at, const Camera& camera,
                                 const CalibrateOptions& options);

/// Flat field of a camera, computed from frames captured while the camera moves.
struct FlatFieldCalibration {
    Camera camera;  ///< the given camera with `flat_field` set
    int frames = 0;
    double min_brightness = 0;  ///< minimum brightness of the flat field, relative to its maximum
    /// Rms deviation of the mean frame from the flat field, relative to the flat field. The
    /// deviation is caused by dots that did not average out completely, and by differences in pixel
    /// sensitivity.
    double residual = 0;
};

/// Computes the flat field of a camera from at least 20 frames of a sheet or of white paper, taken
/// with constant exposure and light. The dots must be at different pixel positions in different
/// frames, so that they average out. If no camera is given, the result is a new camera whose image
/// size is the size of the frames. The only option used is `progress`. Throws Error in these cases:
/// - There are fewer than 20 frames, or frames differ in size.
/// - The flat field is less than kMinFlatField in the darkest part of the image.
/// - The mean frame deviates from the flat field by more than 8 % (rms).
FlatFieldCalibration calibrate_flat_field(int frames, const FrameAt& frame_at,
                                          const std::optional<Camera>& camera,
                                          const CalibrateOptions& options);

/// Readout time of a rolling shutter, computed from the frames of a drive.
struct ReadoutCalibration {
    Camera camera;  ///< the given camera with `readout_ms` set
    int frames = 0;
    int located = 0;
    double sigma_ms = 0;  ///< standard deviation of the readout time
    double motion = 0;    ///< rms motion during the readout, in spacings
};

/// Computes the readout time of a camera that moves over a sheet, from at least 7 consecutive
/// frames, taken at intervals of `interval_ms`. Compares the motion during the readout of each
/// frame with the motion from the previous frame to the next. Throws Error in these cases:
/// - The camera file has no view of the paper.
/// - There are fewer than 5 located frames whose previous and next frames are also located.
/// - The standard deviation of the readout time is 10 % of the readout time or more.
ReadoutCalibration calibrate_readout(int frames, const FrameAt& frame_at, const Camera& camera,
                                     double interval_ms, const CalibrateOptions& options);

/// Reference for the print scales of sheets. The frames determine the print scales of all sheets
/// and axes relative to each other, but not the absolute scale.
struct ScaleReference {
    enum class By {
        /// There is no absolute reference. The mean of the two print scales of the fixed sheet
        /// remains unchanged.
        fixed_sheet,
        /// The scale of the camera, in mm per px, is assumed to be correct. Requires a camera that
        /// was calibrated with the true spacing.
        camera,
        width  ///< the width of one sheet was measured
    };
    By by = By::fixed_sheet;
    std::string sheet;    ///< name of the sheet whose width was measured
    double width_mm = 0;  ///< measured width, from the first to the last column of intersections
};

/// Prior standard deviation of a print scale: the usual relative deviation of the true print scale
/// from the value in the sheet file.
inline constexpr double kUsualPrintError = 0.003;
/// Returns true if the frames determined a print scale: its standard deviation `sigma_scale` is
/// less than half of the prior standard deviation.
inline constexpr bool is_scale_known(double sigma_scale) {
    return sigma_scale < kUsualPrintError / 2;
}

/// Accuracy of the pose of one sheet after stitching.
struct StitchedSheet {
    std::string name;
    /// Standard deviation, per axis, of the position of the sheet's top left corner relative to the
    /// fixed sheet.
    double sigma_mm = 0;
    double sigma_rad = 0;  ///< standard deviation of the yaw
    bool is_fixed = false;
    double sigma_scale_x = 0;  ///< standard deviations of the print scales
    double sigma_scale_y = 0;
};
/// Two sheets that appear together in some frames.
struct Seam {
    std::string first;
    std::string second;
    int frames = 0;
    /// Rms difference, per axis, between the frame positions computed from the two sheets.
    double residual_mm = 0;
    /// Rms difference between the frame directions computed from the two sheets.
    double residual_rad = 0;
};
/// Position of the image centre of one frame, computed separately on each of two sheets. Each
/// position is relative to the first intersection of the sheet, in nominal mm.
struct SeamMeasurement {
    std::size_t first = 0;  ///< index of the first sheet
    std::size_t second = 0;
    double first_x_mm = 0;
    double first_y_mm = 0;
    double second_x_mm = 0;
    double second_y_mm = 0;
};
/// World poses of sheets, with measures of their accuracy.
struct Stitching {
    /// The input sheets, in the same order. Stitched sheets have new world poses and print scales.
    std::vector<SheetEntry> sheets;
    std::vector<StitchedSheet> stitched;
    std::vector<Seam> seams;
    /// Measurements from all frames that show at least two connected sheets. In each frame, the
    /// sheet with the largest number of dots is paired with every other connected sheet.
    std::vector<SeamMeasurement> measurements;
    /// Names of the sheets that are not connected to the fixed sheet by any chain of frames.
    std::vector<std::string> unconnected;
    int frames = 0;
    int used = 0;              ///< number of frames that show at least two sheets
    ScaleReference reference;  ///< reference for the print scales
};

/// Computes the world poses and print scales of sheets from frames that show parts of two sheets. A
/// sheet is a candidate for the fixed sheet if some frame shows it together with another sheet. The
/// first candidate with a world pose is fixed and keeps this pose. If no sheet has a world pose,
/// the first candidate is fixed and defines the world: its corner is the origin, and its upper edge
/// is the x axis.
///
/// `camera` contains the lens and, for mounted cameras, the view of the paper. If the view is not
/// known, it is fitted separately for each sheet in a frame. The poses are then less accurate, and
/// correct only if the fixed sheet was printed with the print scales in the sheet file.
///
/// Throws Error in these cases:
/// - There are fewer than two sheets, or no frame shows two sheets.
/// - Some sheets have a world pose, but no frame shows one of them together with another sheet.
/// - The reference is the width of a sheet, and no chain of frames connects this sheet to the fixed
///   sheet.
/// - The reference is the camera, and the mean print scale of a sheet differs from 1 by more than
///   25 %.
///
/// Throws BadArgument if the reference is the camera, but the view of the paper is not known. Also
/// throws BadArgument if the reference is the width of a sheet, but the sheet does not exist or the
/// width is not above 0.
Stitching stitch_sheets(int frames, const FrameAt& frame_at, std::vector<SheetEntry> sheets,
                        const std::optional<Camera>& camera, const CalibrateOptions& options,
                        const ScaleReference& reference = {});

}  // namespace dotpose

DOTPOSE_END_EXPORT

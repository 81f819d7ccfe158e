/// Calibration from the sheet itself: every dot's true place is known, so any printed sheet is a
/// calibration target.
///
///     const auto frame_at = [&](int i) { return read_image(names[i]); };
///     const LensCalibration lens = calibrate_lens(20, frame_at, {});
///     write_camera("camera.yaml", lens.camera);
///
/// `calibrate_lens` finds the lens and the scale, `calibrate_spin` and `calibrate_drive` where the
/// camera sits on a robot, `stitch_sheets` how sheets lie beside each other. What frames cannot
/// tell is refused (Error) with advice. Standard deviations are those of one estimate, from the
/// residuals of the fit.
///
/// Frames are asked for by their index, several times, and not kept. Functions share no state.
#pragma once

#include <filesystem>
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

/// Frame `index` of the series, from 0. May throw Error.
using FrameAt = std::function<GreyImage(int index)>;

struct CalibrateOptions {
    /// What was printed; only profile and spacing matter. True lengths follow the true spacing.
    Pattern pattern;
    /// The profile is found out from the frames, whatever `pattern` says. Not when stitching:
    /// sheets have theirs.
    bool any_code = false;
    /// Told after each part of the work; return false to give up (throws Error).
    std::function<bool(int done, int total)> progress;
};

/// The profile, if it is given.
std::optional<Profile> given_code(const CalibrateOptions& options);

/// Frames that are asked for; with fewer the verdict is `too_few_frames`.
inline constexpr int kWantedFrames = 5;

enum class CalibrationVerdict {
    good,
    too_few_frames,  ///< under kWantedFrames
    same_place,      ///< all frames show the same dots: their printing errors look like the lens's
    out_of_focus,    ///< dots are blurred to a third of the spacing
    corners_unseen,  ///< too few dots near the image corners
};
const char* name(CalibrationVerdict verdict);

/// One dot of one frame: by how much it is off where the camera's model has it, in px of the
/// undistorted image.
struct CalibrationDot {
    int frame = 0;      ///< its index
    PixelPoint pixel;   ///< where it was seen
    PixelPoint before;  ///< residual of a camera without distortion, skew and tilt
    PixelPoint after;   ///< residual of the calibrated camera
};

struct LensCalibration {
    Camera camera;
    /// Whether the camera is mounted: all frames share height and tilt. Otherwise it was moved by
    /// hand, and each frame has its own; `camera.paper` and `camera.tilt` are then not known.
    bool is_mounted = true;
    Profile code = Profile::anoto;  ///< given, or found out
    int frames = 0;                 ///< given
    int located = 0;                ///< of these: with a fix
    int duplicates = 0;             ///< of these: the same image as an earlier one; left out
    int dots = 0;                   ///< used
    int outliers = 0;               ///< dots left out
    double residual_before_px = 0;  ///< rms per axis, of a camera without distortion, skew and tilt
    double residual_px = 0;         ///< rms per axis
    double px_per_spacing = 0;      ///< at the centre, mean over the frames
    double dot_width = 0;           ///< at half depth, in spacings; a sharp dot: 1/6
    double coverage = 0;            ///< share of the image, 12 x 8 parts, that shows dots
    CalibrationVerdict verdict = CalibrationVerdict::good;
    std::string advice;  ///< one or two sentences for the user
    std::vector<CalibrationDot> seen;
};

/// Lens, scale, and as far as the frames tell it tilt and focal length. Throws Error: no pattern in
/// any frame, a single frame, frames of different sizes, all frames the same image.
LensCalibration calibrate_lens(int frames, const FrameAt& frame_at,
                               const CalibrateOptions& options);

/// The image centre of one frame of a turn, from the point that stays put: along the pattern's
/// axes.
struct SpinStation {
    double x_mm = 0;
    double y_mm = 0;
    double theta_rad = 0;
    double off_x_mm = 0;  ///< where this frame alone has the point that stays put, less where it is
    double off_y_mm = 0;
};

enum class MountVerdict {
    good,
    drifted,  ///< the robot moved on while it turned, by more than chance explains
};
const char* name(MountVerdict verdict);

/// Where the camera sits: the point that stays put while the robot turns on the spot.
struct SpinCalibration {
    Camera camera;  ///< the one given, with `reference_px` set
    /// The same point in mm from what the image centre looks at, along the image axes there.
    CameraPoint offset_mm;
    int frames = 0;
    int located = 0;
    double sigma_mm = 0;     ///< standard deviation of the point, per axis
    double residual_mm = 0;  ///< rms of the frames about it, per axis: how well the robot stood
    double turn_rad = 0;     ///< smallest arc that holds all angles
    /// By how much a robot that moved on while it turned falsifies the point, per axis; part of
    /// `sigma_mm`. 0: it stayed, as far as chance lets that be told.
    double drift_mm = 0;
    MountVerdict verdict = MountVerdict::good;
    std::vector<SpinStation> stations;
};

/// At least 3 frames over more than 30 degrees; a full turn in 12 is good. `camera`: its lens and
/// view; none: without distortion. Throws Error: too few frames with a fix, too small a turn,
/// frames of other sizes, a point farther off than a camera file can say; no point stays put to one
/// spacing (rms per axis), or it is not told to half a spacing.
SpinCalibration calibrate_spin(int frames, const FrameAt& frame_at,
                               const std::optional<Camera>& camera,
                               const CalibrateOptions& options);

/// Which way the camera looks: from frames of a straight drive forwards, in order.
struct DriveCalibration {
    Camera camera;  ///< the one given, with `theta_offset_rad` set
    int frames = 0;
    int located = 0;
    double sigma_rad = 0;    ///< of the offset
    double residual_mm = 0;  ///< rms of the places from a straight line
    double length_mm = 0;    ///< of the drive
};

/// At least 2 frames over more than 5 mm. Throws Error: too few frames with a fix, frames of other
/// sizes, too short a drive, a robot that turned by more than 5 degrees off its mean direction, or
/// left the straight line by more than that, or went back.
DriveCalibration calibrate_drive(int frames, const FrameAt& frame_at,
                                 const std::optional<Camera>& camera,
                                 const CalibrateOptions& options);

/// What makes print scales true. Frames tell how much longer one sheet was printed than another
/// one, and than along its other axis; but no frame tells what a millimetre is.
struct ScaleReference {
    enum class By {
        fixed_sheet,  ///< nothing: the mean of both print scales of the fixed sheet stays
        camera,       ///< the camera's mm per px are true, as calibrated with a true spacing
        width         ///< the true width of a sheet was measured
    };
    By by = By::fixed_sheet;
    std::string sheet;    ///< whose width
    double width_mm = 0;  ///< from the first to the last column of intersections
};

/// What is known of print scales before the first frame: this is their deviation from what the
/// sheet file says.
inline constexpr double kUsualPrintError = 0.003;
/// Whether frames told a print scale, rather than the sheet file.
inline constexpr bool is_told(double sigma_scale) {
    return sigma_scale < kUsualPrintError / 2;
}

/// One sheet, after stitching.
struct StitchedSheet {
    std::string name;
    double sigma_mm = 0;   ///< of the place of its corner against the fixed sheet, per axis
    double sigma_rad = 0;  ///< of its yaw
    bool is_fixed = false;
    double sigma_scale_x = 0;  ///< of its print scales
    double sigma_scale_y = 0;
};
/// Two sheets that some frames show together.
struct Seam {
    std::string first;
    std::string second;
    int frames = 0;
    double residual_mm = 0;   ///< rms per axis, of the frames
    double residual_rad = 0;  ///< rms
};
/// The image centre of one frame by both sheets: from their first intersections, in mm as meant to
/// be printed.
struct SeamSighting {
    std::size_t first = 0;  ///< index of the sheet
    std::size_t second = 0;
    double first_x_mm = 0;
    double first_y_mm = 0;
    double second_x_mm = 0;
    double second_y_mm = 0;
};
struct Stitching {
    std::vector<SheetEntry>
        sheets;  ///< those given, in order; world poses and print scales of those stitched set
    std::vector<StitchedSheet> stitched;
    std::vector<Seam> seams;
    std::vector<SeamSighting> sightings;   ///< of connected sheets
    std::vector<std::string> unconnected;  ///< sheets that no seam joins to the fixed one
    int frames = 0;
    int used = 0;              ///< frames that show two sheets
    ScaleReference reference;  ///< of the print scales
};

/// Lays sheets out in the world by frames that show parts of two, and finds by how much they were
/// printed longer than meant. Of the sheets seen beside another one, the first with a world pose
/// keeps it; if no sheet has one, the first becomes the world: its corner the origin, its upper
/// edge the x axis. `camera`: lens and view; without a view, which only mounted cameras have, it is
/// fitted to each part of a frame. Then places are less exact, and they hold if the fixed sheet was
/// printed to the scales that the sheet file says. Throws Error: no sheets, no frame shows two of
/// them, none of those shown lies in the world though others do, the sheet of the reference not
/// among those joined; BadArgument: a reference that does not exist.
Stitching stitch_sheets(int frames, const FrameAt& frame_at, std::vector<SheetEntry> sheets,
                        const std::optional<Camera>& camera, const CalibrateOptions& options,
                        const ScaleReference& reference = {});

/// Draws the residual fields before and after, and the dots' coverage of the image, as SVG.
/// Throws Error if the file cannot be written.
void draw_calibration(const std::filesystem::path& path, const LensCalibration& calibration);

/// Draws where the camera was while the robot turned, and where each frame has the point that stays
/// put. Throws Error if the file cannot be written.
void draw_spin(const std::filesystem::path& path, const SpinCalibration& calibration);

/// Draws how sheets lie, as the sheet file had it before and as stitched, with the disagreement of
/// frames over the seams. Throws Error if the file cannot be written.
void draw_stitching(const std::filesystem::path& path, std::span<const SheetEntry> before,
                    const Stitching& stitching);

}  // namespace dotpose

#pragma GCC visibility pop

/// Follower: locates images on the sheets of a sheet file and follows a robot over these sheets.
///
///     FollowerOptions options;
///     options.sheets = read_sheets("sheets.json");
///     Follower follower(options);
///     for (;;) {
///         const Followed now = follower.follow(image.view(), time_us);
///         if (now.located.place) use(now.located.place->x_mm, now.track.pose);
///     }
///
/// Functions throw BadArgument if an image does not have the size given in the camera file.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "dotpose/code_evidence.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/flat_field.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "dotpose/tools/pen.hpp"
#include "dotpose/tools/print_mapping.hpp"
#include "dotpose/tools/space_pose.hpp"
#include "dotpose/tools/space_track.hpp"
#include "dotpose/track.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Sheets, code and camera of a Follower.
struct FollowerOptions {
    DeviceOptions locate;
    /// The sheets that may be in view. If empty, poses are in the pattern frame.
    std::vector<SheetEntry> sheets;
    /// True if only these sheets can be in view. If false, other sheets are also located if enough
    /// of their dots are in view. See Locator::set_known.
    bool has_only_sheets = false;
    /// The code variant, or none to detect it from all images together. Ignored if there are
    /// sheets, because each sheet has its own code variant.
    std::optional<CodeVariant> code;
    /// Spacing of the pattern, in mm, if there are no sheets.
    double spacing_mm = kDefaultSpacing_mm;
    /// Lens, view and mount of the camera. Images must have the size given in the camera file.
    std::optional<Camera> camera;
    /// True to flip images left to right before they are located. Has the same effect as `flip` in
    /// a camera file. All pixel coordinates refer to the flipped images.
    bool flip = false;
    /// Reference pixel of the pose. Overrides the reference point in the camera file and the
    /// default, which is the image centre.
    std::optional<PixelPoint> reference_px;
    /// True to fit the pose of the camera in space, in addition to the pose on the paper. Requires
    /// a camera file with a focal length.
    bool fits_space_pose = false;
    /// Map of the print, used to correct fixes and poses in space (print_mapping.hpp). `sheets`
    /// must contain the sheets of the map.
    PrintMap print_map;
    TrackOptions track;
    SpaceTrackOptions space_track;  ///< used only if `fits_space_pose` is set
};

/// The result for a single image.
struct Located {
    /// The pose of the reference point, corrected with the camera file if there is one.
    Fix fix;
    std::optional<SheetPlace> place;  ///< place of the fix, or none if the fix is not on any sheet
    /// Code variant of the fix. Also contains a place in another code variant if such a place
    /// explains the image too. In results of `locate`, `reading.fix` is the fix before the
    /// correction with the camera file. In results of `follow`, `reading.fix` equals `fix`, except
    /// that its `p_wrong` does not include the prior (see Followed).
    CodeReading reading;
    /// Nominal spacing, in mm, of the sheet that contains the fix. If the fix is not on any sheet,
    /// this is the common spacing of all sheets, or NaN if the sheets differ in spacing. If there
    /// are no sheets, it is FollowerOptions::spacing_mm.
    double spacing_mm = 0;
    /// Spacing computed from the fix and the view in the camera file, in mm. NaN if unknown.
    /// `contradicts` (mounted_pose.hpp) compares this spacing with `spacing_mm`.
    double camera_spacing_mm = std::numeric_limits<double>::quiet_NaN();
    /// Velocity of the camera during the readout. None if there is no fix, or if the camera file
    /// does not contain the readout time of a rolling shutter.
    std::optional<ReadoutVelocity> velocity;
    /// Pose of the camera in space, if `FollowerOptions::fits_space_pose` is set. None if there is
    /// no fix, if the spacing is not known, or if too few dots are in view (see `space_pose`).
    std::optional<SpacePose> space;
    /// Tip of the pen in the pattern frame. None if `space` is none or ambiguous, or if the camera
    /// file contains no tip.
    std::optional<TipPose> tip;
    bool is_pen_down = false;  ///< true if `tip` is on the paper (see PenContact)
    /// Result of applying `FollowerOptions::print_map` to the fix.
    MapUse map_use = MapUse::no_map;
    /// True if the options or the sheets determine which code variants are tried. False if all code
    /// variants are tried.
    bool code_is_given = false;
    int reduced_by = 1;  ///< factor by which the image was downscaled before it was located
};

/// The result for one image of a sequence. It depends on the previous images.
struct Followed {
    /// Result for the image. If the fix was accepted only because it is at the predicted place, its
    /// `p_wrong` includes the prior probability of that place.
    Located located;
    Track track;
    /// Track of the camera in space. If the robot is tracked in the world, the track is in the
    /// coordinate frame that `world_sighting` (space_track.hpp) uses. Otherwise, it is in the
    /// pattern frame. None if `FollowerOptions::fits_space_pose` is not set.
    std::optional<SpaceTrack> space_track;
};

/// Converts a fix on a sheet to a sighting in the world frame, for the Tracker of a robot that
/// drives over several sheets. `place` is the place of the fix. Returns nullopt if the world pose
/// of the sheet is not known. The fix must be ok, and its `spacing_nm` must be known, that is,
/// above 0.
std::optional<Sighting> world_sighting(const Fix& fix, const SheetPlace& place,
                                       std::int64_t time_us);

/// Locates single images, or the images of a sequence in order.
class Follower {
  public:
    /// Throws BadArgument in these cases:
    /// - Poses in space are required, but the camera file is missing or has no focal length.
    /// - The camera has a flat field and is not valid.
    /// - The region of a sheet is not inside the code plane.
    ///
    /// Throws Error if the print map contains a page that is not one of the sheets.
    explicit Follower(const FollowerOptions& options);

    /// Locates a single image, without a prediction from previous images. Downscales images larger
    /// than `kMaxFrameSide_px`, unless there is a camera file. Only the evidence for the code
    /// variant and the measured error rate are carried over from image to image.
    Located locate(const GreyImage& image);

    /// Locates the next image of a sequence, taken at `time_us`. Uses the previous images to
    /// predict the place of the pattern. A fix that is not certain from this image alone is
    /// accepted only if the tracker accepts it with the prior probability of the predicted place
    /// (Verdict::with_prior).
    Followed follow(ImageView image, std::int64_t time_us);

    /// Returns true if the robot is tracked in the world frame of the sheet file (m, y up) instead
    /// of the pattern frame.
    bool is_in_world() const { return is_in_world_; }
    const std::vector<SheetEntry>& sheets() const { return options_.sheets; }

    /// Replaces the sheets, for example after a sheet was moved in the world. The next image starts
    /// a new track, but the error rate is still measured over all images. Invalidates
    /// `SheetPlace::entry` of earlier results. Throws BadArgument if there
    /// are no sheets, or if the region of a sheet is not inside the code plane. Throws Error if the
    /// print map contains a page that is not among the sheets.
    void set_sheets(std::vector<SheetEntry> sheets);

    bool fits_space_pose() const { return options_.fits_space_pose; }
    /// Returns true if the pose of a pen tip is computed for each image.
    bool finds_tip() const {
        return options_.fits_space_pose && options_.camera && options_.camera->tip;
    }

    /// Replaces the camera file, for example after a new calibration. The next image starts a new
    /// track, because the reference point may have moved on the robot, and a new measurement of the
    /// error rate. Throws BadArgument if the camera is invalid, or if it has no focal length and
    /// poses in space are required.
    void set_camera(const Camera& camera);

    /// Results for the latest image: the image as it was located (possibly flipped, downscaled, or
    /// corrected with the flat field), the options that were used, and the trace of the stages.
    ImageView image() const { return image_; }
    const DeviceOptions& used_options() const { return used_; }
    Trace trace() const { return locator_.trace(); }

  private:
    struct Found {
        Fix seen;  ///< fix before the correction with the camera file
        Fix fix;
        std::optional<SheetPlace> place;  ///< place of `seen`
        CodeReading reading;
        std::optional<ReadoutVelocity> velocity;
        std::optional<SpacePose> space;
        MapUse map_use = MapUse::no_map;
        ComparedBits compared;
    };
    /// The result for the latest image with a fix.
    struct Seen {
        Fix fix;
        CodeVariant code;
        std::optional<Sighting> sighting;
    };

    void require_space_camera() const;
    void use_flat_field();
    void use_sheets();
    void use_options_for(int width_px, int height_px);
    ImageView as_located(ImageView image);
    Locator& locator(const DeviceOptions& options);
    Found by_camera_file(const Fix& seen, const std::optional<SheetPlace>& place,
                         const CodeReading& reading) const;
    std::optional<SpacePose> space_of(const Fix& seen, const std::optional<SheetPlace>& place,
                                      MapUse map_use) const;
    double spacing_mm(const std::optional<SheetPlace>& place) const;
    Fix with_spacing(const Fix& fix, const std::optional<SheetPlace>& place) const;
    Located located(const Found& found, const Fix& fix) const;

    // Functions for single images.
    Found read();
    Found read_in(CodeVariant code);
    Fix without_surroundings(const Fix& fix, const SheetPlace& place);

    // Functions for sequences of images.
    std::optional<Prediction> predict(std::int64_t time_us) const;
    Found find(int max_p_wrong_log2, const std::optional<Prediction>& expected);
    Found look(ImageView image, const DeviceOptions& options,
               const std::optional<Prediction>& expected);
    Fix locate_near(ImageView image, const DeviceOptions& options,
                    const std::optional<Prediction>& expected);
    Found look_in_any_code(const std::optional<Prediction>& expected);
    Found without_neighbours(const Found& found);
    std::optional<Sighting> sighting_of(const Found& found, std::int64_t time_us) const;
    SpaceTrack track_in_space(const Located& located, const std::optional<Sighting>& sighting,
                              std::int64_t time_us);
    void start_tracks();
    void remember(const Found& found, const std::optional<Sighting>& sighting);

    FollowerOptions options_;
    /// Code variants in the order in which they are tried, starting with the code variant of the
    /// last fix. If empty, all code variants are tried.
    std::vector<CodeVariant> codes_;
    CodeEvidence evidence_;       ///< evidence for the code variant, from the previous images
    ErrorRate error_rate_;        ///< measured over the previous images
    double unplaced_spacing_mm_;  ///< spacing for a fix that is not on any sheet
    bool is_in_world_ = false;
    DeviceOptions used_;
    ImageView image_;
    std::optional<FlatFieldCorrection> flat_field_;
    GreyImage corrected_;  ///< image after the flip and the flat-field correction
    GreyImage reduced_;
    std::vector<KnownRegion> known_;  ///< regions of the sheets
    Locator locator_{DeviceOptions{}};
    Tracker tracker_;
    SpaceTracker space_tracker_;
    PenContact contact_;
    /// The result for the latest image with a fix. None if there was no fix, or if the fix is too
    /// old for a prediction.
    std::optional<Seen> seen_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT

/// Camera: the optics of one camera, its view of the paper and its mounting on a robot.
///
/// Coordinate frames:
/// - *pixel*: the centre of the first pixel is (0, 0), and v points down.
/// - *undistorted* pixel: the pixel at which a camera without distortion would show the same scene
///   point. It may be outside the image.
/// - *camera*: coordinates on the paper in mm, relative to the point that is visible at the
///   distortion centre. x is along the image x axis, and y points DOWN.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Image point in px, relative to the centre of the first pixel: u to the right, v down.
struct PixelPoint {
    double u = 0;
    double v = 0;
};

/// The map from the undistorted image to the paper, for a camera that is mounted at a fixed height.
/// The undistorted pixel that is (a, b) px from the distortion centre shows the point with these
/// coordinates in the camera frame:
///
///     x = mm_per_px_x (a + skew b) / d,   y = mm_per_px_y b / d,
///     d = 1 + perspective_u a + perspective_v b.
struct PaperScale {
    double mm_per_px_x = 0;
    double mm_per_px_y = 0;
    double skew = 0;  ///< shift of each image row relative to the row above, in px
    /// Change in d per px along u and v. Both are 0 if the optical axis is perpendicular to the
    /// paper.
    double perspective_u = 0;
    double perspective_v = 0;
};

/// Tilt of the paper relative to the image plane. Angles and signs are defined as in `CameraPose`
/// (tools/simulate.hpp).
struct Tilt {
    /// Tilt about the image x axis. If positive, the paper recedes towards the bottom of the image.
    double x_rad = 0;
    /// Tilt about the image y axis. If positive, the paper comes closer towards the right.
    double y_rad = 0;
};

/// Minimum value in `Camera::flat_field`. `validate` rejects smaller values, because image areas
/// that dark are too noisy to show dots.
inline constexpr double kMinFlatField = 0.05;

/// Pinhole model of the undistorted image. The undistorted pixel (u, v) shows the scene points in
/// this direction from the projection centre:
///
///     ((u - centre_px.u) / focal_u_px, (v - centre_px.v) / focal_v_px, 1).
///
/// x is along the image x axis, y is down in the image, and z is along the optical axis.
struct Pinhole {
    double focal_u_px = 0;
    double focal_v_px = 0;
    PixelPoint centre_px;  ///< pixel on the optical axis
};

/// Position of the tip of a pen relative to the projection centre of the camera. x is along the
/// image x axis, y is down in the image, and z is along the optical axis.
struct PenTip {
    double x_mm = 0;
    double y_mm = 0;
    double z_mm = 0;
    /// Height of the tip above the paper while the pen rests on the paper, as measured by the
    /// calibration. The height is not necessarily 0: the tip is the point about which the pen
    /// pivots, for example the centre of the ball in a ballpoint pen.
    double rest_mm = 0;
};

/// Contents of a camera file: one camera and its mounting on a robot.
struct Camera {
    int width_px = 0;
    int height_px = 0;
    /// Coefficient k of the division model (paper, equations 1 and 2) for radial distortion about
    /// `centre_px`. Negative for barrel distortion.
    double k_per_px2 = 0;
    PixelPoint centre_px;
    /// View of the paper: the map from the undistorted image to the paper. None if the camera is
    /// hand-held, or if the view is not known.
    std::optional<PaperScale> paper;
    /// Focal length. None if the calibration did not determine it.
    std::optional<double> focal_px;
    /// Pinhole model of a camera whose pixels are not square, or whose optical axis does not pass
    /// through `centre_px`. ROS camera_info files can describe such cameras. None for other
    /// cameras: `pinhole_of` derives their model from `focal_px`.
    std::optional<Pinhole> pinhole;
    /// Tilt of a mounted camera. None if the calibration did not determine the tilt.
    std::optional<Tilt> tilt;

    /// Reference point of the pose: an undistorted pixel, which may be outside the image. If not
    /// set, the reference point is the image centre.
    std::optional<PixelPoint> reference_px;
    /// Heading of the robot minus the angle of the image x axis at the image centre.
    double theta_offset_rad = 0;

    /// Tip of the pen that contains the camera. None if the camera is not in a pen.
    std::optional<PenTip> tip;

    /// True if the camera delivers mirrored frames. dotpose flips these frames left to right before
    /// it locates them. All pixel coordinates in this struct refer to the flipped frames.
    bool flip = false;

    /// Flat field: the brightness of white paper in the image, relative to its maximum. It includes
    /// lens vignetting and uneven lighting. The samples are stored row by row, and are evenly
    /// spaced from the first to the last pixel along each axis. Each sample is in
    /// [kMinFlatField, 1]. The brightness between the samples is interpolated bilinearly. Empty if
    /// the brightness is uniform or unknown.
    std::vector<std::vector<double>> flat_field;

    /// Readout time of a rolling shutter: the time from the first to the last row of an image. None
    /// for a global shutter, or if the time is not known. If the time is known, the camera velocity
    /// is fitted together with the pose, and the pose refers to the time at which the middle row is
    /// read.
    std::optional<double> readout_ms;

    /// Sensor settings, for information only. dotpose does not use them.
    std::optional<double> exposure_us;
    std::optional<double> gain;

    /// Standard deviations of the calibrated values, in the same units as the values. Each key is
    /// the name of a value in the camera file, for example "centre_u_px".
    std::map<std::string, double> sigma;
};

/// Checks all values except `sigma`. Throws BadArgument in these cases:
/// - `locate` does not accept the image size.
/// - The distortion is too strong: 1 + k r^2 is outside [0.5, 2] in a corner of the image.
/// - The distortion centre is more than 1000 px from the image centre along either axis.
/// - The reference point is more than 10,000 px from the image centre along either axis.
/// - The perspective of `paper` is so strong that the horizon is in the image or near it.
/// - `flat_field` has rows of different lengths, fewer than two rows or columns, or more rows or
///   columns than the image.
/// - Another value is not finite or is out of range, for example a length that is not positive.
void validate(const Camera& camera);

/// Returns the undistorted pixel that corresponds to `pixel` (paper, equations 1 and 2).
PixelPoint undistorted(const Camera& camera, PixelPoint pixel);
/// Inverse of `undistorted`. If k is positive, points far from the distortion centre
/// have no distorted pixel. For such a point, returns the pixel in the same direction from the
/// distortion centre, at twice the distance.
PixelPoint distorted(const Camera& camera, PixelPoint undistorted);

/// Returns `pinhole` if there is one. Otherwise, returns a model with square pixels, `focal_px`,
/// and the optical axis at `centre_px`. Returns nullopt if neither `pinhole` nor `focal_px` is
/// known.
std::optional<Pinhole> pinhole_of(const Camera& camera);

/// A point in the camera frame.
struct CameraPoint {
    double x_mm = 0;
    double y_mm = 0;
};
/// Returns the point on the paper that an undistorted pixel shows, in the camera frame. Throws
/// std::bad_optional_access if `camera.paper` is none.
CameraPoint on_paper(const Camera& camera, PixelPoint undistorted);
/// Returns the undistorted pixel that shows a point given in the camera frame. Throws
/// std::bad_optional_access if `camera.paper` is none.
PixelPoint on_image(const Camera& camera, CameraPoint point);

/// Returns the direction of the image x axis on the paper, at an undistorted pixel. The angle is
/// measured from +x towards +y in the camera frame. Throws std::bad_optional_access if
/// `camera.paper` is none.
double image_axis_rad(const Camera& camera, PixelPoint undistorted);

/// Returns the point on the paper that an undistorted pixel shows, in mm relative to the point
/// under the image centre. x is along the image x axis at the image centre. Throws
/// std::bad_optional_access if `camera.paper` is none. Use these coordinates to compare two
/// calibrations of the same camera. The coordinates of a point on the paper differ by only microns
/// between the calibrations, even far outside the image, whereas its undistorted pixel coordinates
/// differ by more.
CameraPoint from_image_centre(const Camera& camera, PixelPoint undistorted);
/// Inverse of `from_image_centre`: returns the undistorted pixel that shows `point`. Throws
/// std::bad_optional_access if `camera.paper` is none.
PixelPoint pixel_from_image_centre(const Camera& camera, CameraPoint point);

/// Returns the reference point of `camera` as an undistorted pixel of `other`, which is another
/// calibration of the same camera. Returns nullopt if `camera.reference_px` is none. If the view of
/// either camera is not known, returns `camera.reference_px` unchanged.
std::optional<PixelPoint> reference_in(const Camera& other, const Camera& camera);

/// Returns the brightness of white paper at a pixel, relative to the maximum brightness, from
/// `camera.flat_field`. The flat field must not be empty, and `camera` must be valid.
double brightness_at(const Camera& camera, PixelPoint pixel);

/// Returns a camera whose images are crops of the images from `camera`. A crop has `width_px` x
/// `height_px` pixels, and its top left pixel is (`left_px`, `top_px`). The reference point remains
/// the same point of the scene. If `camera.reference_px` is none, this is the point at the centre
/// of the original image. If the view of the paper is known, the heading also remains the same.
/// `flat_field` and `readout_ms` are adapted to the crop. Throws BadArgument if the crop extends
/// beyond the image, or if the result is not a valid camera (see `validate`).
Camera part_of(const Camera& camera, int left_px, int top_px, int width_px, int height_px);

/// Sets the lens in `options`, and the reference point if the camera has one. If the camera's view
/// of the paper is known, also sets `show_stages`, because `with_camera` needs the dots in the
/// trace. Throws BadArgument if `width_px` x `height_px` is not the image size of the camera.
void use_camera(const Camera& camera, int width_px, int height_px, DeviceOptions& options);

}  // namespace dotpose

DOTPOSE_END_EXPORT

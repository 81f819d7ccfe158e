/// Coverage of a lens calibration: the parts of the image, places and directions that the frames
/// have covered so far, and the requirements that have not been met yet. Intended for programs that
/// capture frames while the camera moves, such as `dotpose calibrate --live`.
///
///     CalibrationCoverage coverage(640, 480);
///     coverage.add(view);  // for each frame taken
///     for (const CalibrationNeed& need : coverage.missing(camera)) say(need.advice);
///
/// There is no shared state. Only `corner_sigma_px` throws an exception.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Minimum fraction of the parts of the image (see ImageCoverage) in which dots are seen. Below
/// this fraction, the verdict of a calibration is `corners_unseen`.
inline constexpr double kMinCoverage = 0.85;
/// Maximum width of dots in focus, in spacings. Dots that are blurred to twice their printed width
/// begin to touch.
inline constexpr double kWidestDot = 0.32;
/// Required number of distinct places on the sheet at which frames were taken (see
/// `CalibrationCoverage::places`).
inline constexpr int kWantedPlaces = 4;
/// Required number of distinct camera directions (see `CalibrationCoverage::directions`). Frames in
/// different directions are needed to distinguish lens distortion from a print that is stretched
/// along one axis.
inline constexpr int kWantedDirections = 3;
/// Required accuracy of the lens calibration: the maximum standard deviation of the undistorted
/// position of the farthest image corner (see `corner_sigma_px`).
inline constexpr double kWantedCornerSigma_px = 0.1;

/// Returns the corner of the image that is farthest from the distortion centre.
PixelPoint farthest_corner(const Camera& camera);

/// Returns the standard deviation, in px, of the undistorted position of the farthest image corner,
/// relative to the middle of the image. It is computed from the standard deviations of `k_per_px2`
/// and of the distortion centre. Assumes that the errors of k and of the centre are independent.
/// Throws std::out_of_range if `camera.sigma` does not contain these standard deviations.
double corner_sigma_px(const Camera& camera);

/// Divides the image into kColumns x kRows equal parts, and records the parts in which dots have
/// been seen.
class ImageCoverage {
  public:
    static constexpr int kColumns = 12;
    static constexpr int kRows = 8;

    /// Creates an empty coverage for images of the given size, which must be positive.
    ImageCoverage(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

    /// Marks the part of the image that contains a pixel. Ignores pixels outside the image. Returns
    /// true if the part was not marked before.
    bool add(PixelPoint pixel);

    bool is_covered(int column, int row) const {
        return covered_[static_cast<std::size_t>(row * kColumns + column)];
    }
    /// Returns the fraction of the parts that are marked.
    double fraction() const;

  private:
    int width_px_;
    int height_px_;
    std::array<bool, std::size_t{kColumns} * kRows> covered_{};
};

/// One located frame.
struct CalibrationView {
    std::vector<PixelPoint> dots;  ///< measured pixel coordinates of the dots
    double x_grid = 0;             ///< pattern position under the image centre, in spacings
    double y_grid = 0;
    Section section;
    double theta_rad = 0;  ///< angle of the image x axis in the pattern frame
    double spacing_px = 0;
};

/// A requirement that the frames taken so far do not meet.
struct CalibrationNeed {
    enum class Kind { image, places, directions, frames, lens };
    Kind kind = Kind::frames;
    std::string advice;  ///< one line for the user
};

/// The combined coverage of all frames taken so far.
class CalibrationCoverage {
  public:
    /// Number of equal sectors into which a full turn is divided to count directions.
    static constexpr int kDirections = 8;

    /// Creates an empty coverage for images of the given size, which must be positive.
    CalibrationCoverage(int width_px, int height_px);

    /// Returns the number of parts of the image in which this frame shows dots but no earlier frame
    /// does.
    int parts_added_by(const CalibrationView& view) const;
    /// Adds a frame.
    void add(const CalibrationView& view);

    int frames() const { return frames_; }
    const ImageCoverage& image() const { return image_; }
    /// Returns the number of distinct places. A frame adds a place if the pattern position under
    /// its image centre is far enough from all earlier places in the same section. The minimum
    /// distance corresponds to a quarter of the shorter image side.
    int places() const { return static_cast<int>(places_.size()); }
    /// Returns the number of sectors that contain the direction of at least one frame.
    int directions() const;
    /// Returns true if the image x axis of at least one frame points into sector `direction`.
    /// Sectors are numbered from the pattern's x axis towards its y axis.
    bool has_direction(int direction) const {
        return directions_[static_cast<std::size_t>(direction)];
    }

    /// Returns the requirements that have not been met yet, the most urgent first. The list is
    /// empty if the frames are sufficient. `lens` is the calibration computed from the frames so
    /// far, if there is one.
    std::vector<CalibrationNeed> missing(const std::optional<Camera>& lens) const;

  private:
    struct Place {
        double x_grid;
        double y_grid;
        Section section;
    };

    bool is_image_covered() const;
    std::string image_advice() const;

    int shorter_side_px_;
    int frames_ = 0;
    ImageCoverage image_;
    std::vector<Place> places_;
    std::array<bool, kDirections> directions_{};
};

}  // namespace dotpose

DOTPOSE_END_EXPORT

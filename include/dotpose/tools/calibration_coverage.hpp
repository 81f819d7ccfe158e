/// What the frames of a lens calibration have shown so far, and what is still missing: for programs
/// that take frames while the camera moves, as `dotpose calibrate --live` does.
///
///     CalibrationCoverage coverage(640, 480);
///     coverage.add(view);  // of each frame that is taken
///     for (const CalibrationNeed& need : coverage.missing(camera)) say(need.advice);
///
/// Functions share no state and do not fail.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/files/camera.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Share of the parts of the image that must show dots; below it the verdict of a calibration is
/// `corners_unseen`.
inline constexpr double kLeastCoverage = 0.85;
/// Dots wider than this, in spacings, are out of focus: at twice their printed width they begin to
/// touch.
inline constexpr double kWidestDot = 0.32;
/// Number of places on the sheet that the frames should show.
inline constexpr int kWantedPlaces = 4;
/// Number of directions, of `CalibrationCoverage::kDirections`, in which the frames should be
/// taken: a printer that stretches one axis of the paper then looks different from a lens.
inline constexpr int kWantedDirections = 3;
/// Uncertainty of the lens in the corner of the image that is small enough: see `corner_sigma_px`.
inline constexpr double kWantedCornerSigma_px = 0.1;

/// Returns the corner of the image that is farthest from the distortion centre.
PixelPoint farthest_corner(const Camera& camera);

/// Returns how uncertain a calibration of the lens leaves the farthest corner: the standard
/// deviation, in px, of where a camera without distortion would see it from the middle of the
/// image. It is that of `k_per_px2` and the distortion centre, whose errors are taken as
/// independent. `camera.sigma` must hold their standard deviations.
double corner_sigma_px(const Camera& camera);

/// Which parts of the image have shown dots.
class ImageCoverage {
  public:
    static constexpr int kColumns = 12;
    static constexpr int kRows = 8;

    /// For images of this size, which must not be empty.
    ImageCoverage(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

    /// Marks the part of the image that a pixel lies in; pixels outside of the image lie in none.
    /// Returns whether the part had not been marked before.
    bool add(PixelPoint pixel);

    bool is_covered(int column, int row) const {
        return covered_[static_cast<std::size_t>(row * kColumns + column)];
    }
    /// Returns the share of the parts that are marked.
    double share() const;

  private:
    int width_px_;
    int height_px_;
    std::array<bool, std::size_t{kColumns} * kRows> covered_{};
};

/// What one located frame shows.
struct CalibrationView {
    std::vector<PixelPoint> dots;  ///< pixels of the image where dots were read
    double x_grid = 0;             ///< place under the image centre, in spacings
    double y_grid = 0;
    Section section;
    double theta_rad = 0;  ///< angle of the image x axis in the pattern frame
    double spacing_px = 0;
};

/// Something that the frames taken so far do not show.
struct CalibrationNeed {
    enum class Kind { image, places, directions, frames, lens };
    Kind kind = Kind::frames;
    std::string advice;  ///< what to do, in one line
};

/// What the frames that were taken show together.
class CalibrationCoverage {
  public:
    /// Number of parts of the full turn that directions are counted by.
    static constexpr int kDirections = 8;

    /// For images of this size, which must not be empty.
    CalibrationCoverage(int width_px, int height_px);

    /// Returns the number of parts of the image that this frame would be the first to cover.
    int parts_added_by(const CalibrationView& view) const;
    /// Adds a frame.
    void add(const CalibrationView& view);

    int frames() const { return frames_; }
    const ImageCoverage& image() const { return image_; }
    /// Returns the number of places, at least a quarter of the shorter side of the image apart.
    int places() const { return static_cast<int>(places_.size()); }
    /// Returns the number of directions.
    int directions() const;
    /// Whether a frame was taken whose image x axis points into part `direction` of the full turn,
    /// counted from the pattern's x axis towards its y axis.
    bool has_direction(int direction) const {
        return directions_[static_cast<std::size_t>(direction)];
    }

    /// Returns what is still missing, the most urgent first; nothing once the frames are enough.
    /// `lens` is the calibration by the frames so far, if there is one yet.
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

#pragma GCC visibility pop

// Computes the offsets of the dots on a page and the poses of all frames together, by sparse least
// squares.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "calibrate/map_field.hpp"

namespace dotpose::calibrate {

/// Observation of a dot in one frame: the index of the dot on the page, and the measured position
/// of the dot on the paper, in mm, in the camera frame.
struct MapObservation {
    /// Bit that marks an observation as an outlier. Outliers are not used.
    static constexpr std::uint32_t kOutlier = 1U << 31;
    std::uint32_t dot = 0;
    float x_mm = 0;
    float y_mm = 0;

    bool is_outlier() const { return (dot & kOutlier) != 0; }
    std::uint32_t index() const { return dot & ~kOutlier; }
};

/// Number of view terms: scale, two shear terms and two perspective terms. Their values may differ
/// between frames.
inline constexpr int kViewTerms = 5;
/// Number of terms that are common to all frames: the view terms and the lens distortion.
inline constexpr int kCameraTerms = kViewTerms + 1;
/// Number of parameters of a frame: position (2), angle, displacement of the dots, and the view
/// terms.
inline constexpr int kFrameTerms = 4 + kViewTerms;
using FrameVector = Eigen::Matrix<double, kFrameTerms, 1>;
using FrameBlock = Eigen::Matrix<double, kFrameTerms, kFrameTerms>;
using CameraVector = Eigen::Matrix<double, kCameraTerms, 1>;

/// Pose and view of a frame. The point P in the camera frame corresponds to the point place +
/// R(angle) (P + view terms) on the page.
struct MapFrame {
    std::size_t first = 0;  ///< index of the first observation
    std::size_t count = 0;  ///< number of observations
    Eigen::Vector2d place_mm = Eigen::Vector2d::Zero();
    double angle_rad = 0;
    double displacement_mm = 0;
    Eigen::Matrix<double, kViewTerms, 1> view = Eigen::Matrix<double, kViewTerms, 1>::Zero();
};

struct MapGrid {
    int columns = 0;
    int rows = 0;
    Eigen::Vector2d pitch_mm = Eigen::Vector2d::Zero();
    /// Direction of the displacement of each dot, along x and along y: -1, 0 or 1.
    std::vector<std::array<std::int8_t, 2>> directions;

    std::size_t dots() const { return directions.size(); }
    /// Returns the column and the row of a dot.
    std::array<int, 2> cell_of(std::size_t dot) const {
        const auto wide = static_cast<std::size_t>(columns);
        return {static_cast<int>(dot % wide), static_cast<int>(dot / wide)};
    }
    Eigen::Vector2d place_mm(std::size_t dot) const {
        const auto [column, row] = cell_of(dot);
        return {pitch_mm.x() * column, pitch_mm.y() * row};
    }
    /// Returns the position of a dot without its offset: the intersection plus the displacement.
    Eigen::Vector2d place_mm(std::size_t dot, double displacement_mm) const {
        return place_mm(dot) +
               displacement_mm * Eigen::Vector2d(directions[dot][0], directions[dot][1]);
    }
};

/// Offsets of the dots in an earlier map, and the number of views of each dot. Empty if there is no
/// earlier map.
struct EarlierOffsets {
    std::vector<Eigen::Vector2f> offset_mm;
    std::vector<float> views;
};

/// Covariances of the map error at the nodes of a grid (see `MapErrors`), in mm and rad.
struct MapErrorGrid {
    int columns = 0;
    int rows = 0;
    std::vector<Eigen::Matrix3d> covariances;
};

/// Unknowns and statistics of a map.
struct MapSolution {
    std::vector<MapFrame> frames;
    CameraVector camera = CameraVector::Zero();  ///< terms that are common to all frames
    double reach_mm = 1;                         ///< unit of lengths in the view terms
    MapField field;                              ///< slowly varying part of the offsets
    std::vector<Eigen::Vector2f> offset_mm;      ///< offset of each dot
    std::vector<std::uint32_t> views;            ///< number of views of each dot
    double noise_mm = 0;                         ///< see MapPage::noise
    double jitter_mm = 0;                        ///< see MapPage::jitter
    /// Frame-to-frame standard deviation of each view term, estimated by `solve_map`.
    std::array<double, kViewTerms> view_sigma{};
    MapErrorGrid errors;
    std::size_t outliers = 0;
    int iterations = 0;  ///< number of conjugate gradient iterations in all rounds
};

/// Called after each step with the completed fraction of the computation. May throw to cancel the
/// computation.
using MapProgress = std::function<void(double fraction)>;

/// Computes the offsets of the dots, refines the poses of the frames, and marks outliers.
/// `solution` must contain the approximate poses of the frames, and the observations of each frame
/// must be consecutive.
void solve_map(const MapGrid& grid, const EarlierOffsets& earlier, double reach_mm,
               std::vector<MapObservation>& observations, MapSolution& solution,
               const MapProgress& progress);

}  // namespace dotpose::calibrate

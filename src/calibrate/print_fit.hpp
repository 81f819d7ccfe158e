// Print fit: one map for a whole field, fitted to all its dots.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// A dot: its place on the paper as meant, and as seen.
struct Match {
    Eigen::Vector2d nominal_mm;
    Eigen::Vector2d seen;  ///< px, or mm of a scan of known resolution
};

/// The ways in which an image may have been taken.
enum class ViewModel {
    flat,         ///< on a scanner: lengths in the image are those on the paper, along each axis
    perspective,  ///< by a camera without distortion
    camera,       ///< by a camera whose lens distorts radially
};

/// The map of a field: seen = lens_centre + q (1 + lens q^2), with q = offset + (linear * d) / (1 +
/// perspective . d), d = nominal - centre.
struct PlaneFit {
    Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
    Eigen::Vector2d perspective_per_mm = Eigen::Vector2d::Zero();
    Eigen::Vector2d lens_centre = Eigen::Vector2d::Zero();
    double lens = 0;      ///< per squared unit of `seen`
    double residual = 0;  ///< rms per axis, without outliers

    /// Returns where a place of the paper is seen.
    Eigen::Vector2d seen(const Eigen::Vector2d& nominal_mm) const;
    /// Returns the units of `seen` per mm at a place of the paper: the square root of the ratio of
    /// areas.
    double units_per_mm(const Eigen::Vector2d& nominal_mm) const;
};

/// Fits the map by least squares, twice: the second time without dots more than four standard
/// deviations off. Needs at least 8 matches that are not on one line. `lens_centre` is used by
/// ViewModel::camera only.
PlaneFit fit_plane(const std::vector<Match>& matches, ViewModel model,
                   const Eigen::Vector2d& lens_centre = Eigen::Vector2d::Zero());

}  // namespace dotpose::calibrate

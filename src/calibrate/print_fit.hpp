// One map for a whole field, fitted to all its dots.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// A dot: where it should be on the paper, and where it is seen.
struct Match {
    Eigen::Vector2d nominal_mm;
    Eigen::Vector2d seen;  ///< px, or mm of a scan of known resolution
};

/// seen = offset + (linear * d) / (1 + perspective . d), with d = nominal - centre.
struct PlaneFit {
    Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
    Eigen::Vector2d perspective_per_mm = Eigen::Vector2d::Zero();
    double residual = 0;  ///< rms per axis, without outliers

    Eigen::Vector2d seen(const Eigen::Vector2d& nominal_mm) const;
};

/// Least squares, twice: the second time without dots that lie more than four standard deviations
/// off. Needs at least 8 matches that are not on one line.
PlaneFit fit_plane(const std::vector<Match>& matches, bool with_perspective);

}  // namespace dotpose::calibrate

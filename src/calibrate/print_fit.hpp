// Fits one map to all dots in a field.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

/// Nominal and measured position of a dot.
struct Match {
    Eigen::Vector2d nominal_mm;
    Eigen::Vector2d seen;  ///< in px for a photo, or in mm for a scan with known resolution
};

/// Models of the projection from the page to the image.
enum class ViewModel {
    flat,         ///< scanner: one scale along each axis
    perspective,  ///< camera without distortion
    camera,       ///< camera with radial lens distortion
};

/// Map from the page to the image: seen = lens_centre + q (1 + lens q^2), where q = offset +
/// (linear * d) / (1 + perspective . d) and d = nominal - centre.
struct PlaneFit {
    Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
    Eigen::Vector2d perspective_per_mm = Eigen::Vector2d::Zero();
    Eigen::Vector2d lens_centre = Eigen::Vector2d::Zero();
    double lens = 0;      ///< in 1 / (unit of `seen`)^2
    double residual = 0;  ///< rms residual per axis, without outliers

    /// Returns the image position of a point on the page.
    Eigen::Vector2d seen(const Eigen::Vector2d& nominal_mm) const;
    /// Returns the local scale at a point on the page, in units of `seen` per mm. The scale is the
    /// square root of the ratio of image area to page area.
    double units_per_mm(const Eigen::Vector2d& nominal_mm) const;
};

/// Fits the map by least squares in two rounds. The second round excludes dots with residuals above
/// four standard deviations. Needs at least 8 matches that are not collinear. `lens_centre` is used
/// only by ViewModel::camera.
PlaneFit fit_plane(const std::vector<Match>& matches, ViewModel model,
                   const Eigen::Vector2d& lens_centre = Eigen::Vector2d::Zero());

}  // namespace dotpose::calibrate

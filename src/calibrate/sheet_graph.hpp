// Graph of sheets and frames (images). An edge connects a frame to each sheet that it shows. The
// relative poses and the print scales of the sheets are computed from this graph.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <ceres/problem.h>

#include "calibrate/seam_frames.hpp"

namespace dotpose::calibrate {

/// Pose in a plane with x to the right and y DOWN: x and y in mm, and turn in radians from +x
/// towards +y.
struct PlanePose {
    double x = 0;
    double y = 0;
    double turn = 0;

    /// Returns the composition of two poses. `inner` is relative to this pose.
    PlanePose operator*(const PlanePose& inner) const;
    PlanePose inverse() const;
};

/// Graph of sheets and frames. The poses are determined by least squares.
class SheetGraph {
  public:
    /// `fixed` is the index of the fixed sheet. The corner and the upper edge of its page define
    /// the coordinate frame of all poses.
    SheetGraph(const std::vector<SheetEntry>& sheets, const std::optional<Camera>& camera,
               std::vector<SheetView> views, std::size_t fixed, const ScaleReference& reference);

    /// Computes the poses and print scales of all sheets that are connected to the fixed sheet.
    void solve();

    bool is_connected(std::size_t sheet) const { return nodes_[sheet].has_value(); }
    /// Returns the pose of a page: the position of its corner and the direction of its upper edge.
    /// The sheet must be connected.
    PlanePose pose(std::size_t sheet) const;
    AxisScale print_scale(std::size_t sheet) const;
    double sigma_mm(std::size_t sheet) const;
    double sigma_rad(std::size_t sheet) const;
    AxisScale sigma_scale(std::size_t sheet) const;
    /// Returns the position of the image centre on the sheet according to one view, in nominal mm
    /// from the first intersection of the sheet.
    Eigen::Vector2d centre_on_sheet(const SheetView& view) const;
    /// Returns the pose of the image centre according to one view, relative to the fixed sheet.
    PlanePose image_centre(const SheetView& view) const;

  private:
    /// Position of the corner of the page in mm, direction of its upper edge in radians, and
    /// logarithms of the two print scales.
    using Node = std::array<double, 5>;
    using FramePose = std::array<double, 3>;
    /// Derivative of the six whitened residuals of a view with respect to the position of one dot.
    /// The columns are x and y on the sheet.
    using DotDerivative = Eigen::Matrix<double, 6, 2>;

    Eigen::Vector2d centre_in_camera(const SheetView& view) const;
    void spread_from_fixed();
    void start_frames();
    void fit();
    void add_views(ceres::Problem& problem);
    void pin_sheets(ceres::Problem& problem);
    void pin_camera(ceres::Problem& problem);
    void estimate_variances(ceres::Problem& problem, double cost);
    std::vector<DotDerivative> dot_derivatives(const SheetView& view) const;
    Eigen::VectorXd print_variances(const Eigen::MatrixXd& gain) const;
    bool has_scale() const;

    const std::vector<SheetEntry>& sheets_;
    std::optional<Camera> camera_;
    std::vector<SheetView> views_;
    std::size_t fixed_;
    ScaleReference reference_;

    std::vector<std::optional<Node>> nodes_;  ///< empty for sheets that are not connected
    std::vector<Node> variances_;
    /// Poses of the camera's coordinate system, indexed by frame number.
    std::map<int, FramePose> frames_;
    /// Scale of the camera relative to the fixed sheet: the logarithm of the mean scale, then the
    /// aspect, then the skew.
    std::array<double, 3> camera_scale_{};
};

}  // namespace dotpose::calibrate

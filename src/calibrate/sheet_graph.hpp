// Sheet graph: a graph of sheets and frames, linked where a frame shows a sheet. It finds how
// sheets lie beside each other, and how long they were printed.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <ceres/problem.h>

#include "calibrate/seam_frames.hpp"

namespace dotpose::calibrate {

/// Place and direction on a plane with x right, y DOWN: mm and radians, from +x towards +y.
struct PlanePose {
    double x = 0;
    double y = 0;
    double turn = 0;

    /// Returns the pose of `inner`, which is given in the frame of this pose.
    PlanePose operator*(const PlanePose& inner) const;
    PlanePose inverse() const;
};

/// The graph, and its solution by least squares.
class SheetGraph {
  public:
    /// `fixed` is the index of the sheet whose page's corner and upper edge are the frame of all
    /// poses.
    SheetGraph(const std::vector<SheetEntry>& sheets, const std::optional<Camera>& camera,
               std::vector<SheetView> views, std::size_t fixed, const ScaleReference& reference);

    /// Finds the poses and print scales of all sheets that are connected to the fixed one.
    void solve();

    bool is_connected(std::size_t sheet) const { return nodes_[sheet].has_value(); }
    /// Returns the pose of the page's corner and upper edge. The sheet must be connected.
    PlanePose pose(std::size_t sheet) const;
    AxisScale print_scale(std::size_t sheet) const;
    double sigma_mm(std::size_t sheet) const;
    double sigma_rad(std::size_t sheet) const;
    AxisScale sigma_scale(std::size_t sheet) const;
    /// Return the image centre by one view: in mm from the sheet's first intersection as it was
    /// meant to be printed, and as a pose.
    Eigen::Vector2d centre_on_sheet(const SheetView& view) const;
    PlanePose image_centre(const SheetView& view) const;

  private:
    /// Place of the page's corner, direction of the upper edge, and logarithms of the print scales.
    using Node = std::array<double, 5>;
    using FramePose = std::array<double, 3>;
    /// Derivative of the whitened residuals of a view by the place of one of its dots, along x and
    /// y of the sheet.
    using DotShare = Eigen::Matrix<double, 6, 2>;

    Eigen::Vector2d centre_in_camera(const SheetView& view) const;
    void spread_from_fixed();
    void start_frames();
    void fit();
    void add_views(ceres::Problem& problem);
    void pin_sheets(ceres::Problem& problem);
    void pin_camera(ceres::Problem& problem);
    void estimate_variances(ceres::Problem& problem, double cost);
    std::vector<DotShare> dot_shares(const SheetView& view) const;
    Eigen::VectorXd print_variances(const Eigen::MatrixXd& gain) const;
    bool has_scale() const;

    const std::vector<SheetEntry>& sheets_;
    std::optional<Camera> camera_;
    std::vector<SheetView> views_;
    std::size_t fixed_;
    ScaleReference reference_;

    std::vector<std::optional<Node>> nodes_;  ///< none if not connected
    std::vector<Node> variances_;
    std::map<int, FramePose> frames_;  ///< poses of the camera frame
    /// The camera's mm relative to those of the fixed sheet: logarithm of the scale, aspect, skew.
    std::array<double, 3> camera_scale_{};
};

}  // namespace dotpose::calibrate

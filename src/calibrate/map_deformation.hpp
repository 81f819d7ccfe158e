// The part of the preconditioner that handles slow deformations of the page. A slow deformation
// varies little over the width of a frame and moves all dots in the frame together, so a change in
// the frame's pose nearly cancels the effect of the deformation on the residuals. If the
// preconditioner consisted only of the diagonal blocks of single frames, slow deformations would
// need many iterations to converge. This part therefore solves for the deformation and the poses
// together.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "calibrate/map_field.hpp"
#include "calibrate/map_solver.hpp"
#include "calibrate/map_unknowns.hpp"

namespace dotpose::calibrate {

/// The equations for slow deformations. A deformation consists of a shift along x, a shift along y,
/// and a change in the displacement of the dots. These three values are interpolated bilinearly
/// between coarse nodes, and determine all unknowns of the map:
/// - The field is equal to the shifts.
/// - The offset of a dot is the shift plus the change in the displacement of the dot.
/// - The terms of a frame are a least-squares fit to the offsets of its dots.
class MapDeformation {
  public:
    MapDeformation(const MapGrid& grid, const EarlierOffsets& earlier,
                   const std::vector<MapObservation>& observations, const MapSolution& solution);

    /// Solves the equations with the right-hand side `residual`, and adds the resulting deformation
    /// to `result`.
    void add_solution(const MapUnknowns& residual, MapUnknowns& result) const;

    /// Returns the covariance of three linear functions of the deformation. Row i of `functions`
    /// contains the coefficients of function i. The coefficients for node n begin at column
    /// first_term(n).
    Eigen::Matrix3d covariance_of(const Eigen::Matrix<double, 3, Eigen::Dynamic>& functions) const;
    /// Returns the coarse nodes.
    const MapField& nodes() const { return nodes_; }
    /// Returns the number of unknowns: the shift along x, the shift along y, and the change in the
    /// displacement for each coarse node.
    Eigen::Index unknowns() const { return first_term(nodes_.nodes()); }
    static Eigen::Index first_term(std::size_t node);

  private:
    using Following = Eigen::Matrix<float, kFrameTerms, Eigen::Dynamic>;

    /// Response of a frame to a deformation. `nodes` are the coarse nodes around the frame's dots.
    /// Each column of `terms` contains the terms of the frame for a deformation in which one
    /// unknown of these nodes is 1 and all other unknowns are 0.
    struct Follower {
        std::vector<std::uint32_t> nodes;
        Following terms;  ///< columns: shift x, shift y and displacement of each node
    };
    /// Response of a frame, and the contribution of the frame to the matrix. The rows and columns
    /// of `matrix` are in the order of `follower.nodes`.
    struct FrameEquations {
        Follower follower;
        Eigen::MatrixXd matrix;
    };

    FrameEquations equations_of(const MapGrid& grid,
                                const std::vector<MapObservation>& observations,
                                const MapSolution& solution, const MapFrame& frame) const;
    void add_frames(const MapGrid& grid, const std::vector<MapObservation>& observations,
                    const MapSolution& solution, Eigen::MatrixXd& matrix);
    /// Adds the equations for the offsets in the earlier map and for the prior on the offsets.
    void add_dots(const MapGrid& grid, const EarlierOffsets& earlier, const MapSolution& solution,
                  Eigen::MatrixXd& matrix) const;
    void add_smoothness(const MapField& field, Eigen::MatrixXd& matrix) const;

    MapField nodes_;
    std::vector<MapField::Around> field_nodes_;  ///< coarse nodes around each node of the field
    std::vector<Follower> followers_;            ///< response of each frame
    Eigen::LLT<Eigen::MatrixXd> equations_;
};

}  // namespace dotpose::calibrate

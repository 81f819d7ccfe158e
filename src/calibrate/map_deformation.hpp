// Map deformation: preconditioner for slow deformations of the page. The frames follow a slow
// deformation and hardly see it, so the blocks of single frames do not solve for it.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "calibrate/map_field.hpp"
#include "calibrate/map_solver.hpp"
#include "calibrate/map_unknowns.hpp"

namespace dotpose::calibrate {

/// The equations for slow deformations. A deformation consists of shifts along x and y, and of a
/// change of the displacement of the dots, which are bilinear between coarse nodes. The field and
/// the offsets have the value of the deformation. Each frame has the terms that fit it best.
class MapDeformation {
  public:
    MapDeformation(const MapGrid& grid, const EarlierOffsets& earlier,
                   const std::vector<MapObservation>& observations, const MapSolution& solution);

    /// Adds the deformation that solves the equations for `residual` to `result`.
    void add_solution(const MapUnknowns& residual, MapUnknowns& result) const;

  private:
    using Following = Eigen::Matrix<float, kFrameTerms, Eigen::Dynamic>;

    /// Terms of a frame for deformations at the nodes of its dots.
    struct Follower {
        std::vector<std::uint32_t> nodes;
        Following terms;  ///< columns: shifts and displacement of each node
    };
    /// A frame, with its part of the equations.
    struct FrameEquations {
        Follower follower;
        Eigen::MatrixXd matrix;
    };

    FrameEquations equations_of(const MapGrid& grid,
                                const std::vector<MapObservation>& observations,
                                const MapSolution& solution, const MapFrame& frame) const;
    void add_frames(const MapGrid& grid, const std::vector<MapObservation>& observations,
                    const MapSolution& solution, Eigen::MatrixXd& matrix);
    /// Adds the equations of earlier offsets and of the prior of the offsets.
    void add_dots(const MapGrid& grid, const EarlierOffsets& earlier, const MapSolution& solution,
                  Eigen::MatrixXd& matrix) const;
    void add_smoothness(const MapField& field, Eigen::MatrixXd& matrix) const;

    MapField nodes_;
    std::vector<MapField::Around> field_nodes_;  ///< coarse nodes around each node of the field
    std::vector<Follower> followers_;            ///< of each frame
    Eigen::LLT<Eigen::MatrixXd> equations_;
};

}  // namespace dotpose::calibrate

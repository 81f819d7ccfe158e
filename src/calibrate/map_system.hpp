// The linear equations of a print map, from which the offsets of the dots are eliminated (Schur
// complement). This elimination is cheap, because each offset occurs only in the equations of one
// dot.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "calibrate/map_deformation.hpp"
#include "calibrate/map_solver.hpp"
#include "calibrate/map_unknowns.hpp"

namespace dotpose::calibrate {

/// Equations of a map, linearised at the frame poses of a solution.
class MapSystem {
  public:
    MapSystem(const MapGrid& grid, const EarlierOffsets& earlier,
              const std::vector<MapObservation>& observations, const MapSolution& solution);

    /// Solves the equations by preconditioned conjugate gradients. Stops when the mean square of
    /// the preconditioned residual is at most `converged` times the variance of an unknown, or
    /// after kMaxIterations. Updates the frames, camera, field and offsets in `solution`, which
    /// must be the solution passed to the constructor.
    void solve(MapSolution& solution, double converged, const MapProgress& progress);
    const MapDeformation& deformation() const { return deformation_; }

  private:
    enum class Residuals : bool { omit, add };

    MapUnknowns zeros() const;
    MapUnknowns unknowns_of(const MapSolution& solution) const;
    /// Returns the product of the matrix and `at`. If `residuals` is Residuals::add, subtracts the
    /// right-hand side, so the result is the gradient at `at`.
    MapUnknowns product(const MapUnknowns& at, Residuals residuals);
    /// Sets `offsets_` to the most likely offsets, given the values `at` of the other unknowns.
    void eliminate(const MapUnknowns& at, Residuals residuals);
    void add_frames(const MapUnknowns& at, Residuals residuals, MapUnknowns& result) const;
    void add_field(const MapUnknowns& at, MapUnknowns& result) const;
    void make_preconditioner();
    MapUnknowns preconditioned(const MapUnknowns& residual) const;
    void write(const MapUnknowns& at, MapSolution& solution);

    /// Preserves the scale of the page: sets the scale of the camera and the mean scale of the
    /// frames to 0. Without this constraint, a smaller page would have smaller residuals.
    static void keep_scale(MapUnknowns& unknowns);

    const MapGrid& grid_;
    const EarlierOffsets& earlier_;
    const std::vector<MapObservation>& observations_;
    const MapSolution& solution_;
    double weight_;        ///< weight of an observation: 1 / noise^2
    double prior_weight_;  ///< weight of the prior on an offset, given the field: 1 / jitter^2
    std::vector<double> information_;  ///< sum of the equation weights for each offset
    std::vector<Eigen::Vector2d> offsets_;
    /// sums_[part][dot] is the sum of the observed offsets of a dot. Each of the kMapParts parallel
    /// parts accumulates its own sums.
    std::vector<std::vector<Eigen::Vector2d>> sums_;
    std::vector<Eigen::LLT<Eigen::Matrix<double, kFrameTerms, kFrameTerms>>> frame_blocks_;
    Eigen::LLT<Eigen::Matrix<double, kCameraTerms, kCameraTerms>> camera_block_;
    std::vector<double> field_diagonal_;
    MapDeformation deformation_;
};

}  // namespace dotpose::calibrate

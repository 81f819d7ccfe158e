// The unknowns of a print map that remain after the elimination of the offsets.
#pragma once

#include <vector>

#include "calibrate/map_solver.hpp"

namespace dotpose::calibrate {

/// Unknowns of a map. The positions, angles and displacements in `frames` are relative to the
/// frames of the solution. The positions are in the camera frame, and the angles are multiplied by
/// `MapSolution::reach_mm`. The view terms, `camera` and `field` are absolute values.
struct MapUnknowns {
    std::vector<FrameVector> frames;
    CameraVector camera = CameraVector::Zero();
    std::vector<Eigen::Vector2d> field;

    double inner(const MapUnknowns& other) const;
    /// Computes *this = scale * *this + by * other.
    void combine(double scale, double by, const MapUnknowns& other);
};

}  // namespace dotpose::calibrate

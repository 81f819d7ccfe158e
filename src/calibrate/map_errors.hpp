// Covariances of the map errors that vary slowly over the page. These errors are nearly the same
// for all dots in a view.
#pragma once

#include "calibrate/map_deformation.hpp"
#include "calibrate/map_solver.hpp"

namespace dotpose::calibrate {

/// Selects what determines the mean offset, rotation and scale of the observed dots: the earlier
/// map, or `fix_gauge`, which sets all three to 0.
enum class Gauge : bool { earlier, fixed };

/// Returns the covariances of the map error (shift and rotation) in views centred on the nodes of a
/// grid over the page. The covariances are computed from the equations for slow deformations. A
/// view is a square whose diagonal is twice the reach of the solution.
MapErrorGrid map_errors(const MapGrid& grid, const MapSolution& solution,
                        const MapDeformation& deformation, Gauge gauge);

}  // namespace dotpose::calibrate

// Map errors: covariances of the errors that all dots of a view share, because the errors of the
// map change slowly over the page.
#pragma once

#include "calibrate/map_deformation.hpp"
#include "calibrate/map_solver.hpp"

namespace dotpose::calibrate {

/// Source of the mean offset, turn and scale of the seen dots. They are those of an earlier map, or
/// fixed at 0 by `fix_gauge`.
enum class Gauge : bool { earlier, fixed };

/// Returns the covariances of the shift and turn of a view, at the nodes of a grid over the page.
/// They are computed from the equations for slow deformations. The size of the views is the reach
/// of the solution.
MapErrorGrid map_errors(const MapGrid& grid, const MapSolution& solution,
                        const MapDeformation& deformation, Gauge gauge);

}  // namespace dotpose::calibrate

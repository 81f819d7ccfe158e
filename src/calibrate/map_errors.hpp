// Covariances of the map errors that all dots of a view share. The dots share errors because the
// errors of the map vary slowly over the page.
#pragma once

#include "calibrate/map_deformation.hpp"
#include "calibrate/map_solver.hpp"

namespace dotpose::calibrate {

/// Source of the mean offset, turn and scale of the dots that were seen: an earlier map, or
/// `fix_gauge`, which sets them to 0.
enum class Gauge : bool { earlier, fixed };

/// Returns the covariances of the shift and turn of a view, at the nodes of a grid over the page.
/// They are computed from the equations for slow deformations. The size of the views is the reach
/// of the solution.
MapErrorGrid map_errors(const MapGrid& grid, const MapSolution& solution,
                        const MapDeformation& deformation, Gauge gauge);

}  // namespace dotpose::calibrate

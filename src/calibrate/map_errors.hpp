// Covariances of the map errors that are common to all dots in a view. Map errors vary slowly over
// the page, so they are nearly the same for all dots in a view.
#pragma once

#include "calibrate/map_deformation.hpp"
#include "calibrate/map_solver.hpp"

namespace dotpose::calibrate {

/// Source of the mean offset, turn and scale of the dots that were seen: an earlier map, or
/// `fix_gauge`, which sets them to 0.
enum class Gauge : bool { earlier, fixed };

/// Returns the covariances of the map error (shift and turn) in views centred on the nodes of a
/// grid over the page. They are computed from the equations for slow deformations. The diagonal of
/// a view is twice the reach of the solution.
MapErrorGrid map_errors(const MapGrid& grid, const MapSolution& solution,
                        const MapDeformation& deformation, Gauge gauge);

}  // namespace dotpose::calibrate

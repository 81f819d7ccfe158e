// Map errors: covariances of the errors that the dots of a view have in common, because the map
// bends slowly.
#pragma once

#include "calibrate/map_deformation.hpp"
#include "calibrate/map_solver.hpp"

namespace dotpose::calibrate {

/// Whether the mean offset, turn and scale of the seen dots are 0 (`fix_gauge`). If not, they are
/// those of an earlier map.
enum class Gauge : bool { earlier, fixed };

/// Returns the covariances of shift and turn of a view at the nodes of a grid over the page. They
/// follow from the equations for slow deformations. The views have the reach of the solution.
MapErrorGrid map_errors(const MapGrid& grid, const MapSolution& solution,
                        const MapDeformation& deformation, Gauge gauge);

}  // namespace dotpose::calibrate

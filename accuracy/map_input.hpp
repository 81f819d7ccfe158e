/// Simulated dots in the frames of a page, for the solver of print maps. No images are rendered.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "../tests/mapped_print.hpp"
#include "calibrate/map_solver.hpp"

namespace dotpose::tables {

/// A page with known offsets, and the dots of its frames.
struct SolverInput {
    calibrate::MapGrid grid;
    std::vector<Eigen::Vector2d> offsets_mm;  ///< the truth
    std::vector<calibrate::MapObservation> observations;
    calibrate::MapSolution start;  ///< with approximate poses of the frames
    double reach_mm = 0;
};

/// Simulates frames at random poses on a print. `seed` determines the poses, the jitter of the dots
/// and the noise.
SolverInput simulated_input(const test::MappedPrint& print, std::uint64_t frames,
                            std::uint64_t seed);

/// Removes the mean place, turn and scale of the dots that were seen from the errors of a solution.
/// Returns the errors of all dots, in mm.
std::vector<Eigen::Vector2d> offset_errors_mm(const SolverInput& input,
                                              const calibrate::MapSolution& solution);

}  // namespace dotpose::tables

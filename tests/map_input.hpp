/// Simulated input for the print map solver: the measured dots in many frames of a page. No images
/// are rendered.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "calibrate/map_solver.hpp"
#include "mapped_print.hpp"

namespace dotpose::test {

/// A page and frames that show parts of it: the true offsets of all dots on the page, and the
/// measured positions of the dots in the frames.
struct SolverInput {
    calibrate::MapGrid grid;
    std::vector<Eigen::Vector2d> offsets_mm;  ///< true offsets
    std::vector<calibrate::MapObservation> observations;
    calibrate::MapSolution start;  ///< initial state, with approximate poses of the frames
    double reach_mm = 0;
};

/// Simulates frames at random poses on a print. `seed` determines the poses and the noise of the
/// measured dots.
SolverInput simulated_input(const MappedPrint& print, std::uint64_t frames, std::uint64_t seed);

/// Returns the error of each dot's offset in a solution, in mm. The frames do not determine the
/// shift, rotation and scale that all dots have in common, so these are fitted to the errors of the
/// dots that are visible in at least one frame, and subtracted from all errors.
std::vector<Eigen::Vector2d> offset_errors_mm(const SolverInput& input,
                                              const calibrate::MapSolution& solution);

}  // namespace dotpose::test

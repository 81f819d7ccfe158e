/// Outcome: what `locate` found in one frame, beside the frame's true pose.
#pragma once

#include <string>

#include "dotpose/fix.hpp"
#include "dotpose/tools/truth.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// A fix farther off than this is wrong: it does not count as an error but as a failure.
inline constexpr double kWrongFrom_grid = 0.5;
inline constexpr double kWrongFrom_deg = 2;

/// Found minus true.
struct Deviation {
    double x_grid = 0;
    double y_grid = 0;
    double theta_rad = 0;  ///< in [-pi, pi]
};
Deviation deviation_of(const Fix& fix, const Truth& truth);

/// One frame, located once.
struct Outcome {
    Fix fix;
    Truth truth;
    double elapsed_us = 0;  ///< of `locate` alone
    std::string problem;    ///< of the file; the rest means nothing then

    bool is_fix() const { return problem.empty() && fix.status == Status::ok; }
    bool is_wrong() const;
};

}  // namespace dotpose

#pragma GCC visibility pop

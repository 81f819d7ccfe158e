/// Outcome: the result of `locate` for one frame, with the true pose.
#pragma once

#include <string>

#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/tools/truth.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Maximum deviation of a correct fix from the truth, in spacings and in degrees. A fix with a
/// larger deviation is wrong. Wrong fixes are not counted as located, and are excluded from the
/// error statistics.
inline constexpr double kWrongFrom_grid = 0.5;
inline constexpr double kWrongFrom_deg = 2;

/// Fix minus truth. The position is in spacings.
struct Deviation {
    double x_grid = 0;
    double y_grid = 0;
    double theta_rad = 0;  ///< in [-pi, pi]
};
/// Returns the deviation of a fix from the truth.
Deviation deviation_of(const Fix& fix, const Truth& truth);

/// The result of one call to `locate`.
struct Outcome {
    Fix fix;
    Truth truth;
    double elapsed_us = 0;  ///< duration of `locate`, without the time to read the frame
    /// Reason why the frame could not be read, or empty. If not empty, `fix` and `elapsed_us` are
    /// not valid.
    std::string problem;

    /// Returns true if the frame was read and has a fix, correct or wrong.
    bool is_fix() const { return problem.empty() && fix.status == Status::ok; }
    /// Returns true if the frame has a wrong fix. A fix is wrong if its deviation is above
    /// kWrongFrom_grid or kWrongFrom_deg, if its section is not the true section, or if the frame
    /// has no true pose.
    bool is_wrong() const;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT

/// Score: the outcomes of many frames, summed up in numbers.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dotpose/status.hpp"
#include "dotpose/tools/outcome.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Quantiles by nearest rank: the least value that at least this share of all values does not
/// exceed. Not a number if there are no values.
struct Quantiles {
    double median = std::numeric_limits<double>::quiet_NaN();
    double p95 = std::numeric_limits<double>::quiet_NaN();
    double max = std::numeric_limits<double>::quiet_NaN();
};
/// Returns the quantiles of some values, in any order.
Quantiles quantiles_of(std::vector<double> values);

/// Counts and errors of many frames.
struct Score {
    int frames = 0;  ///< readable frames; each is located, wrong, or has a status other than ok
    int unreadable = 0;
    int located = 0;                               ///< right fixes
    int wrong = 0;                                 ///< fixes that are wrong
    std::array<int, kStatusCount> by_status = {};  ///< `ok` counts right and wrong fixes

    // Only right fixes count in the following.
    Quantiles position_um;  ///< distance in the plane
    Quantiles angle_deg;
    /// Mean of error^2 / variance, for x, y and theta: 1 if the covariance is right, more if the
    /// errors are larger than it says.
    std::array<double, 3> normalised = {};

    double largest_p_wrong = 0;  ///< largest value given by any fix
    Quantiles elapsed_us;        ///< time of all readable frames

    double located_share() const { return frames > 0 ? 1.0 * located / frames : 0; }
};
/// Returns the score of some outcomes.
Score score_of(std::span<const Outcome> outcomes);

/// Returns the score in words and numbers, for tables: (name, value).
std::vector<std::pair<std::string, std::string>> described(const Score& score);

}  // namespace dotpose

#pragma GCC visibility pop

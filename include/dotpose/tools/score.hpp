/// Score: statistics of the outcomes of many frames.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/status.hpp"
#include "dotpose/tools/outcome.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Quantiles by the nearest-rank method. The quantile for a fraction p is the smallest value v for
/// which at least a fraction p of all values are less than or equal to v. NaN if there are no
/// values.
struct Quantiles {
    double median = std::numeric_limits<double>::quiet_NaN();
    double p95 = std::numeric_limits<double>::quiet_NaN();
    double max = std::numeric_limits<double>::quiet_NaN();
};
/// Returns the quantiles of the given values, which may be in any order.
Quantiles quantiles_of(std::vector<double> values);

/// Counts and error statistics of many frames.
struct Score {
    /// Number of frames that could be read. `unreadable` is the number of frames that could not be
    /// read. Each readable frame has a correct fix, a wrong fix, or a status other than ok.
    int frames = 0;
    int unreadable = 0;
    int located = 0;  ///< number of correct fixes
    int wrong = 0;    ///< number of wrong fixes
    /// Number of frames with each status. The count for `ok` includes wrong fixes.
    std::array<int, kStatusCount> by_status = {};

    // The statistics below, except `largest_p_wrong` and `elapsed_us`, are computed over the
    // correct fixes.
    Quantiles position_um;  ///< distance between the found and the true position
    Quantiles angle_deg;
    /// Mean of error^2 / variance, for x, y and theta. The mean is 1 if the covariance is correct,
    /// and larger if the errors are larger than the covariance predicts. NaN if there are no
    /// correct fixes, or if a correct fix has no covariance.
    std::array<double, 3> normalised = {};

    /// Maximum p_wrong over all fixes, correct or wrong. 0 if there are no fixes.
    double largest_p_wrong = 0;
    Quantiles elapsed_us;  ///< duration of `locate` for each readable frame

    double located_fraction() const { return frames > 0 ? 1.0 * located / frames : 0; }
};
/// Returns the score of the given outcomes.
Score score_of(std::span<const Outcome> outcomes);

/// Returns the score as (name, value) pairs for tables.
std::vector<std::pair<std::string, std::string>> described(const Score& score);

}  // namespace dotpose

DOTPOSE_END_EXPORT

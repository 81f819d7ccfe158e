/// Functions for the protocol of the paper's experiment, used by the figures and the tests.
#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <vector>

#include "dotpose/tools/protocol.hpp"

namespace dotpose::evaluate_detail {

inline constexpr int kPositionsPerSide = 11;
inline constexpr int kAngles = 36;

/// Column and row of a grid position, relative to the centre. y points down.
struct Step {
    int x = 0;
    int y = 0;
    friend constexpr bool operator==(const Step&, const Step&) = default;
};

/// Returns the positions of a square grid in spiral order, from the centre outwards. `side` must be
/// odd. The spiral starts to the right and turns clockwise as seen on the page.
std::vector<Step> spiral(int side);

/// Returns the mean and the sample standard deviation (divisor n - 1). With fewer than two values,
/// the deviation is 0. Without values, the mean is also 0.
Spread spread_of(std::span<const double> values);

/// The best, mean and worst accuracy of the stations with fixes, and their worst precision. The
/// accuracy of a station is the magnitude of Spread::bias, and the precision is Spread::sigma. All
/// values are 0 if no station has a fix.
struct Summary {
    double best = 0;
    double mean = 0;
    double worst = 0;
    double worst_sigma = 0;
    int stations = 0;
};
using SpreadOf = std::function<Spread(const Station&)>;
Summary summary_of(std::span<const Station> stations, const SpreadOf& spread);

/// Draws figure 13, 14 or 15 of the paper from measured poses, with a single panel.
void draw_measured_figure(std::ostream& out, int figure, std::span<const Station> stations,
                          bool is_in_world);

}  // namespace dotpose::evaluate_detail

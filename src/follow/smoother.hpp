// Estimates the path of a point along one axis from noisy positions.
#pragma once

#include <span>
#include <vector>

namespace dotpose::follow {

struct AxisSample {
    double t_s = 0;
    double place_mm = 0;
    double variance_mm2 = 0;
};

/// A smoothed position.
struct AxisPlace {
    double place_mm = 0;
    double variance_mm2 = 0;
};

/// Returns the log-likelihood of the measured positions. `noise` is the power of the white noise
/// that drives the acceleration, in mm^2/s^5.
double log_likelihood(std::span<const AxisSample> samples, double noise);

/// Returns the most probable position at each sample, given all samples (Rauch, Tung and Striebel
/// 1965).
std::vector<AxisPlace> smoothed(std::span<const AxisSample> samples, double noise);

}  // namespace dotpose::follow

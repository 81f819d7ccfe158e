#include "follow/smoother.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace dotpose::follow {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Position, velocity and acceleration, with their covariance.
struct State {
    Vector3d mean;
    Matrix3d covariance;
};

/// Returns the state at the first sample. The standard deviations of velocity and acceleration are
/// typical of a fast-moving hand.
State start_of(const AxisSample& first) {
    constexpr double kVelocity_mm_s = 500;
    constexpr double kAcceleration_mm_s2 = 20'000;
    const Vector3d variances(first.variance_mm2, kVelocity_mm_s * kVelocity_mm_s,
                             kAcceleration_mm_s2 * kAcceleration_mm_s2);
    return {{first.place_mm, 0, 0}, variances.asDiagonal()};
}

Matrix3d transition(double dt) {
    Matrix3d result;
    result << 1, dt, dt * dt / 2, 0, 1, dt, 0, 0, 1;
    return result;
}

State predicted(const State& state, double dt, double noise) {
    const Matrix3d by_state = transition(dt);
    const double d2 = dt * dt;
    const double d3 = d2 * dt;
    Matrix3d added;
    added << d3 * d2 / 20, d2 * d2 / 8, d3 / 6, d2 * d2 / 8, d3 / 3, d2 / 2, d3 / 6, d2 / 2, dt;
    return {by_state * state.mean,
            by_state * state.covariance * by_state.transpose() + noise * added};
}

struct Pass {
    std::vector<State> before;
    std::vector<State> after;
    double log_likelihood = 0;
};

Pass forwards(std::span<const AxisSample> samples, double noise) {
    Pass pass;
    for (const AxisSample& sample : samples) {
        if (pass.after.empty()) {
            pass.before.push_back(start_of(sample));
            pass.after.push_back(pass.before.back());
            continue;
        }
        const double dt = sample.t_s - samples[pass.after.size() - 1].t_s;
        const State prior = predicted(pass.after.back(), dt, noise);
        const double variance = prior.covariance(0, 0) + sample.variance_mm2;
        const double difference = sample.place_mm - prior.mean[0];
        const Vector3d gain = prior.covariance.col(0) / variance;
        pass.log_likelihood -=
            (difference * difference / variance + std::log(2 * std::numbers::pi * variance)) / 2;
        pass.before.push_back(prior);
        pass.after.push_back({prior.mean + gain * difference,
                              prior.covariance - variance * gain * gain.transpose()});
    }
    return pass;
}

}  // namespace

double log_likelihood(std::span<const AxisSample> samples, double noise) {
    return forwards(samples, noise).log_likelihood;
}

std::vector<AxisPlace> smoothed(std::span<const AxisSample> samples, double noise) {
    const Pass pass = forwards(samples, noise);
    std::vector<AxisPlace> places(samples.size());
    State later{Vector3d::Zero(), Matrix3d::Zero()};
    for (std::size_t i = samples.size(); i-- > 0;) {
        State state = pass.after[i];
        if (i + 1 < samples.size()) {
            const Matrix3d by_state = transition(samples[i + 1].t_s - samples[i].t_s);
            const State& prior = pass.before[i + 1];
            const Matrix3d gain =
                prior.covariance.ldlt().solve(by_state * state.covariance).transpose();
            state.mean += gain * (later.mean - prior.mean);
            state.covariance += gain * (later.covariance - prior.covariance) * gain.transpose();
        }
        later = state;
        places[i] = {state.mean[0], state.covariance(0, 0)};
    }
    return places;
}

}  // namespace dotpose::follow

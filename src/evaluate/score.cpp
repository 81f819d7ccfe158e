#include "dotpose/tools/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"

namespace dotpose {
namespace {

double nearest_rank(const std::vector<double>& sorted, double fraction) {
    const double rank = std::ceil(fraction * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

std::string percent(int part, int whole) {
    return whole > 0 ? fmt::format("{:.2f} %", 100.0 * part / whole) : "-";
}

std::string number(double value, int decimals) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string numbers(const Quantiles& quantiles, int decimals) {
    return fmt::format("{} / {} / {}", number(quantiles.median, decimals),
                       number(quantiles.p95, decimals), number(quantiles.max, decimals));
}

}  // namespace

Quantiles quantiles_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    return {nearest_rank(values, 0.5), nearest_rank(values, 0.95), values.back()};
}

Score score_of(std::span<const Outcome> outcomes) {
    Score score;
    std::vector<double> distances_um;
    std::vector<double> angles_deg;
    std::vector<double> times_us;
    for (const Outcome& outcome : outcomes) {
        if (!outcome.problem.empty()) {
            ++score.unreadable;
            continue;
        }
        ++score.frames;
        ++score.by_status[static_cast<std::size_t>(outcome.fix.status)];
        times_us.push_back(outcome.elapsed_us);
        if (!outcome.is_fix()) continue;
        score.largest_p_wrong = std::max(score.largest_p_wrong, outcome.fix.p_wrong());
        if (outcome.is_wrong()) {
            ++score.wrong;
            continue;
        }
        ++score.located;
        const Deviation off = deviation_of(outcome.fix, outcome.truth);
        distances_um.push_back(std::hypot(off.x_grid, off.y_grid) * outcome.truth.spacing_mm *
                               1000);
        angles_deg.push_back(std::abs(off.theta_rad) * kDegrees);
        const double errors[] = {off.x_grid, off.y_grid, off.theta_rad};
        for (std::size_t i = 0; i < score.normalised.size(); ++i) {
            const auto variance = static_cast<double>(outcome.fix.covariance[i][i]);
            score.normalised[i] += outcome.fix.has_covariance()
                                       ? errors[i] * errors[i] / variance
                                       : std::numeric_limits<double>::quiet_NaN();
        }
    }
    for (double& sum : score.normalised)
        sum /= score.located;  // NaN if there are no fixes, as for the quantiles
    score.position_um = quantiles_of(std::move(distances_um));
    score.angle_deg = quantiles_of(std::move(angles_deg));
    score.elapsed_us = quantiles_of(std::move(times_us));
    return score;
}

std::vector<std::pair<std::string, std::string>> described(const Score& score) {
    std::vector<std::pair<std::string, std::string>> rows;
    const auto add = [&rows](std::string what, std::string value) {
        rows.emplace_back(std::move(what), std::move(value));
    };
    add("frames", fmt::format("{}", score.frames));
    if (score.unreadable > 0) add("unreadable", fmt::format("{}", score.unreadable));
    add("located", fmt::format("{} ({})", score.located, percent(score.located, score.frames)));
    add("wrong fixes", fmt::format("{}", score.wrong));
    for (std::size_t i = 1; i < score.by_status.size(); ++i) {
        if (score.by_status[i] == 0) continue;
        add(fmt::format("not located: {}", name(static_cast<Status>(i))),
            fmt::format("{}", score.by_status[i]));
    }
    add("position error, um: median / 95 % / max", numbers(score.position_um, 2));
    add("angle error, degrees: median / 95 % / max", numbers(score.angle_deg, 4));
    add("error^2 / variance, mean: x / y / theta",
        fmt::format("{} / {} / {}", number(score.normalised[0], 2), number(score.normalised[1], 2),
                    number(score.normalised[2], 2)));
    // Smallest probability to report. The model of paper, ink and camera does not justify smaller
    // values.
    constexpr double kMinPWrong = 1e-30;
    const bool has_fix = score.located + score.wrong > 0;
    add("largest p_wrong of a fix",
        has_fix ? fmt::format("{:.1e}", std::max(score.largest_p_wrong, kMinPWrong)) : "-");
    add("time of locate, us: median / 95 % / max", numbers(score.elapsed_us, 1));
    return rows;
}

}  // namespace dotpose

#include "calibrate/print_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "calibrate/least_squares.hpp"

namespace dotpose::calibrate {
namespace {

using Terms = std::array<double, 6>;

/// Least number of tiles for a surface of second degree, and for a plane; with fewer, the edges of
/// the field, where tiles also show other print, have too much weight.
constexpr int kEnoughForCurves = 60;
constexpr int kEnoughForSlopes = 25;

/// Returns the terms of the surface at the middle of a tile, constant, slopes and curves, of which
/// the first `count` are used.
Terms terms_of(int tile, const Tiling& tiling, int count) {
    const double u = 2.0 * (tile % tiling.columns + 0.5) / tiling.columns - 1;
    const double v = 2.0 * (tile / tiling.columns + 0.5) / tiling.rows - 1;
    Terms terms = {1, u, v, u * u, u * v, v * v};
    std::fill(terms.begin() + count, terms.end(), 0.0);
    return terms;
}

/// Returns the height of a surface, given by its coefficients.
double height(const std::vector<double>& surface, const Terms& terms) {
    return std::inner_product(terms.begin(), terms.end(), surface.begin(), 0.0);
}

struct Sample {
    Terms terms;
    double strength = 0;
    double off = 0;  ///< distance from the surface
};

double median(std::vector<Sample>& samples, double Sample::*value) {
    const auto middle = samples.begin() + static_cast<long>(samples.size() / 2);
    std::ranges::nth_element(samples, middle, {}, value);
    return (*middle).*value;
}

/// Fits a surface by least squares, beginning with the median, in rounds without outliers.
std::vector<double> surface_through(std::vector<Sample>& samples) {
    constexpr int kRounds = 5;
    constexpr double kOutlier = 4;  // in medians of the distances
    std::vector<double> surface(6);
    surface[0] = median(samples, &Sample::strength);
    for (int round = 0; round < kRounds; ++round) {
        for (Sample& sample : samples)
            sample.off = std::abs(sample.strength - height(surface, sample.terms));
        const double limit = kOutlier * median(samples, &Sample::off);
        NormalEquations equations(6);
        for (int term = 0; term < 6; ++term)
            equations.pull_to_zero(term, 1e-9);  // for terms that no tile determines
        for (const Sample& sample : samples) {
            if (sample.off <= limit) equations.add(sample.terms, sample.strength);
        }
        surface = equations.solution();
    }
    return surface;
}

}  // namespace

std::vector<double> smooth_strengths(const Field& field, const Tiling& tiling) {
    const auto known =
        std::ranges::count_if(field.maps, [](const auto& map) { return map.has_value(); });
    std::vector<Sample> samples;
    for (int t = 0; t < tiling.count(); ++t) {
        if (!field.maps[static_cast<std::size_t>(t)]) continue;
        const int count = known >= kEnoughForCurves ? 6 : known >= kEnoughForSlopes ? 3 : 1;
        samples.push_back(
            {terms_of(t, tiling, count), field.strengths[static_cast<std::size_t>(t)]});
    }
    std::vector<double> result(field.strengths.size());
    if (samples.empty()) return result;
    const std::vector<double> surface = surface_through(samples);
    // Far from known tiles the surface may take any value, so it is limited.
    const auto [least, most] = std::ranges::minmax(samples, {}, &Sample::strength);
    for (int t = 0; t < tiling.count(); ++t) {
        result[static_cast<std::size_t>(t)] =
            std::clamp(height(surface, terms_of(t, tiling, 6)), least.strength, most.strength);
    }
    return result;
}

}  // namespace dotpose::calibrate

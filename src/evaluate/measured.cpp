// Compares the located positions of frames with independently measured positions.
#include "dotpose/tools/measured.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "dotpose/files/degrees.hpp"
#include "evaluate/protocol.hpp"

namespace dotpose {
namespace {

using evaluate_detail::spread_of;
using Complex = std::complex<double>;

/// Located position and true position of a frame, in mm, as complex numbers x + iy.
struct Pair {
    Complex found;
    Complex truth;
};

/// A similarity transform: truth = offset + factor * found.
struct Map {
    Complex factor = 1;
    Complex offset = 0;
    double residual(const Pair& pair) const {
        return std::abs(offset + factor * pair.found - pair.truth);
    }
};

double wrapped(double angle_rad) {
    return std::remainder(angle_rad, 2 * std::numbers::pi);
}

/// Returns true if the located position and the true position of a frame are known and on the same
/// sheet. If the sheet of the true position is not specified, the located position may be on any
/// sheet.
bool is_comparable(const MeasuredFrame& frame) {
    return frame.truth && frame.found &&
           (frame.truth->sheet.empty() || frame.truth->sheet == frame.found->sheet);
}

Pair pair_of(const MeasuredFrame& frame) {
    return {{frame.found->x_mm, frame.found->y_mm}, {frame.truth->x_mm, frame.truth->y_mm}};
}

double median_of(std::vector<double> values) {
    return quantiles_of(std::move(values)).median;
}

/// Fits a similarity transform by least squares. If all true positions are equal, fits only the
/// offset.
Map fit(std::span<const Pair> pairs) {
    constexpr double kMinSpread_mm = 1e-6;
    const auto count = static_cast<double>(pairs.size());
    Complex found = 0;
    Complex truth = 0;
    for (const Pair& pair : pairs) {
        found += pair.found / count;
        truth += pair.truth / count;
    }
    Complex product = 0;
    double squares = 0;
    double spread_mm = 0;
    for (const Pair& pair : pairs) {
        product += std::conj(pair.found - found) * (pair.truth - truth);
        squares += std::norm(pair.found - found);
        spread_mm = std::max(spread_mm, std::abs(pair.truth - truth));
    }
    Map map;
    if (squares > 0 && spread_mm > kMinSpread_mm) map.factor = product / squares;
    map.offset = truth - map.factor * found;
    return map;
}

double median_residual(std::span<const Pair> pairs, const Map& map) {
    std::vector<double> residuals;
    for (const Pair& pair : pairs)
        residuals.push_back(map.residual(pair));
    return median_of(std::move(residuals));
}

/// Returns the residual above which a pair is an outlier: 5 times the median residual.
double near_limit(std::span<const Pair> pairs, const Map& map) {
    constexpr double kNear_medians = 5;
    return kNear_medians * median_residual(pairs, map) + 1e-9;
}

/// Fits a similarity transform to the pairs that are not outliers. Starts with the fit to all
/// pairs, or with a fit to two of the pairs if that fit has a smaller median residual. Then
/// repeatedly fits a new transform to the pairs within the outlier limit of the previous transform.
Map fit_most(std::span<const Pair> pairs) {
    constexpr std::size_t kTries = 500;
    constexpr int kRounds = 5;
    Map best = fit(pairs);
    double min_median = median_residual(pairs, best);
    const std::size_t n = pairs.size();
    const std::size_t all = n * (n - 1) / 2;
    for (std::size_t k = 0; k < std::min(all, kTries); ++k) {
        // A fit to two points is more accurate if the points are far apart on the sheet. Frames
        // that are far apart in the list are usually also far apart on the sheet.
        const std::size_t apart = 1 + (n / 2 + 7 * (k / n)) % (n - 1);
        const Map map = fit(std::array{pairs[k % n], pairs[(k + apart) % n]});
        const double median = median_residual(pairs, map);
        if (median < min_median) {
            best = map;
            min_median = median;
        }
    }
    for (int round = 0; round < kRounds; ++round) {
        const double limit = near_limit(pairs, best);
        std::vector<Pair> near;
        std::ranges::copy_if(pairs, std::back_inserter(near),
                             [&](const Pair& pair) { return best.residual(pair) <= limit; });
        best = fit(near);
    }
    return best;
}

FoundPlace aligned(const FoundPlace& found, const std::optional<Similarity>& by) {
    if (!by) return found;
    const Complex middle(by->middle_x_mm, by->middle_y_mm);
    const Complex shift(by->shift_x_mm, by->shift_y_mm);
    const Complex at =
        middle + shift +
        std::polar(by->scale, by->turn_rad) * (Complex(found.x_mm, found.y_mm) - middle);
    return {found.sheet, at.real(), at.imag(),
            wrapped(found.angle_rad + by->turn_rad + by->angle_offset_rad)};
}

MeasuredError error_of(const MeasuredFrame& frame, const std::optional<Similarity>& alignment) {
    MeasuredError error;
    error.is_wrong = !is_comparable(frame);
    if (!frame.truth) return error;
    const FoundPlace found = aligned(*frame.found, alignment);
    error.x_mm = found.x_mm - frame.truth->x_mm;
    error.y_mm = found.y_mm - frame.truth->y_mm;
    if (frame.truth->angle_rad)
        error.angle_rad = wrapped(found.angle_rad - *frame.truth->angle_rad);
    return error;
}

/// Marks the frames with wrong positions or angles. A position is wrong if its error exceeds both
/// kWrongFrom_medians times the median error and kWrongFrom_grid spacings. An angle is wrong if its
/// error exceeds both kWrongFrom_medians times the median error and kWrongFrom_deg degrees. Frames
/// that are already marked do not contribute to the medians.
void mark_wrong(const std::vector<MeasuredFrame>& frames,
                std::vector<std::optional<MeasuredError>>& errors) {
    constexpr double kWrongFrom_medians = 10;
    std::vector<double> distances_mm;
    std::vector<double> angles_rad;
    for (const auto& error : errors) {
        if (!error || error->is_wrong) continue;
        distances_mm.push_back(std::hypot(error->x_mm, error->y_mm));
        if (error->angle_rad) angles_rad.push_back(std::abs(*error->angle_rad));
    }
    const double distance_mm = kWrongFrom_medians * median_of(distances_mm);
    const double angle_rad =
        std::max(kWrongFrom_medians * median_of(angles_rad), kWrongFrom_deg / kDegrees);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        auto& error = errors[i];
        if (!error || error->is_wrong) continue;
        const double limit_mm = std::max(distance_mm, kWrongFrom_grid * frames[i].spacing_mm);
        error->is_wrong = std::hypot(error->x_mm, error->y_mm) > limit_mm ||
                          (error->angle_rad && std::abs(*error->angle_rad) > angle_rad);
    }
}

}  // namespace

Similarity align(std::span<const MeasuredFrame> frames) {
    std::vector<Pair> pairs;
    for (const MeasuredFrame& frame : frames) {
        if (is_comparable(frame)) pairs.push_back(pair_of(frame));
    }
    if (pairs.empty()) throw Error("no frame was located at a place that can be compared");
    const Map map = pairs.size() > 1 ? fit_most(pairs) : fit(pairs);
    Complex middle = 0;
    for (const Pair& pair : pairs)
        middle += pair.found / static_cast<double>(pairs.size());
    const Complex shift = map.offset + map.factor * middle - middle;
    Similarity result{middle.real(), middle.imag(),        shift.real(),
                      shift.imag(),  std::arg(map.factor), std::abs(map.factor)};
    // Averages the angles by summing their unit vectors.
    Complex sum = 0;
    const double limit = near_limit(pairs, map);
    for (const MeasuredFrame& frame : frames) {
        if (!is_comparable(frame) || !frame.truth->angle_rad) continue;
        if (map.residual(pair_of(frame)) > limit) continue;
        sum += std::polar(1.0, *frame.truth->angle_rad - frame.found->angle_rad - result.turn_rad);
    }
    if (sum != Complex(0)) result.angle_offset_rad = std::arg(sum);
    return result;
}

Measurement compare(std::vector<MeasuredFrame> frames, const std::optional<Similarity>& alignment) {
    Measurement result;
    result.alignment = alignment;
    for (const MeasuredFrame& frame : frames) {
        if (frame.truth) result.is_in_world = frame.truth->is_in_world;
        result.errors.push_back(frame.found ? std::optional(error_of(frame, alignment))
                                            : std::nullopt);
        // A fix is treated as wrong if its position is not known in the coordinate frame of the
        // true positions.
        if (frame.status == Status::ok && !frame.found) ++result.wrong;
    }
    mark_wrong(frames, result.errors);
    std::vector<double> distances_um;
    std::vector<double> angles_deg;
    std::vector<double> x_um;
    std::vector<double> y_um;
    for (const auto& error : result.errors) {
        if (!error) continue;
        ++(error->is_wrong ? result.wrong : result.located);
        if (error->is_wrong) continue;
        x_um.push_back(1000 * error->x_mm);
        y_um.push_back(1000 * error->y_mm);
        distances_um.push_back(std::hypot(x_um.back(), y_um.back()));
        if (error->angle_rad) angles_deg.push_back(std::abs(*error->angle_rad) * kDegrees);
    }
    result.x_um = spread_of(x_um);
    result.y_um = spread_of(y_um);
    result.position_um = quantiles_of(std::move(distances_um));
    result.angle_deg = quantiles_of(std::move(angles_deg));
    result.frames = std::move(frames);
    return result;
}

}  // namespace dotpose

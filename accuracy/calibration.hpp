/// Functions that measure the errors of calibrations and print the tables in docs/calibration.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/core.h>

#include "table_run.hpp"

namespace dotpose::tables {

/// Error statistics of one parameter, absolute and relative to the reported standard deviations.
struct Errors {
    double squares = 0;
    double normalised_squares = 0;
    double largest = 0;
    int count = 0;

    void add(double error, double sigma) {
        squares += error * error;
        normalised_squares += error * error / (sigma * sigma);
        largest = std::max(largest, std::abs(error));
        ++count;
    }
    Errors& operator+=(const Errors& other) {
        squares += other.squares;
        normalised_squares += other.normalised_squares;
        largest = std::max(largest, other.largest);
        count += other.count;
        return *this;
    }
    double rms() const { return std::sqrt(squares / count); }
    /// Returns the mean of error^2 / variance, or "-" if no standard deviations are reported. The
    /// mean is 1 if the reported standard deviations are correct.
    std::string normalised_text() const {
        return std::isnan(normalised_squares) ? "-"
                                              : fmt::format("{:.2f}", normalised_squares / count);
    }
};

/// Error statistics by parameter name.
using ErrorTable = std::map<std::string, Errors>;
inline ErrorTable& operator+=(ErrorTable& table, const ErrorTable& other) {
    for (const auto& [key, errors] : other)
        table[key] += errors;
    return table;
}

/// Mean and maximum of a quantity.
struct Numbers {
    double sum = 0;
    double largest = 0;
    int count = 0;

    void add(double value) {
        sum += value;
        largest = std::max(largest, value);
        ++count;
    }
    Numbers& operator+=(const Numbers& other) {
        sum += other.sum;
        largest = std::max(largest, other.largest);
        count += other.count;
        return *this;
    }
    double mean() const { return sum / count; }
};

/// Measures the errors of the lens parameters, the residuals, and the errors of positions located
/// with the calibrated cameras. Prints tables in Markdown.
void measure_lenses(std::uint64_t small_cameras, std::uint64_t large_cameras, const TableRun& run);

/// Measures the errors of reference points that are calibrated by turning a robot on the spot.
/// Prints a table.
void measure_spins(std::uint64_t count, const TableRun& run);

/// Measures the errors of the sheet poses that result from stitching four adjacent sheets with
/// different print scales. Prints a table.
void measure_stitching(std::uint64_t count, const TableRun& run);

/// Writes the frames for the example in docs/calibration.md to `folder`.
void write_example(const std::string& folder, std::uint64_t seed);

}  // namespace dotpose::tables

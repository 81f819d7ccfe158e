// Statistics of the errors of many calibrations.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/core.h>

namespace dotpose {

/// Errors of one parameter, and the standard deviations that were reported with it.
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
    /// Returns the mean of error^2 / variance, which is 1 if the reported deviations are true, or
    /// "-" if none are reported.
    std::string normalised_text() const {
        return std::isnan(normalised_squares) ? "-"
                                              : fmt::format("{:.2f}", normalised_squares / count);
    }
};

/// The errors by the name of the parameter.
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

}  // namespace dotpose

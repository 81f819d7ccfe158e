#include "calibrate/map_field.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::calibrate {
namespace {

/// Distance between nodes, in mm. A wave with a wavelength of 40 mm is reproduced to 8 %.
constexpr double kNodePitch_mm = 5;
/// Standard deviation of the second differences of adjacent nodes, in mm. A periodic error of the
/// paper feed with an amplitude of 40 µm and a wavelength of 50 mm has second differences of this
/// size.
constexpr double kDifference_mm = 0.016;

}  // namespace

MapField::MapField(int columns, int rows, double pitch_mm)
    : cells_(std::max(static_cast<int>(std::lround(kNodePitch_mm / pitch_mm)), 1)),
      columns_((columns - 1) / cells_ + 2),
      rows_((rows - 1) / cells_ + 2),
      values_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
              Eigen::Vector2d::Zero()) {}

MapField::Around MapField::around(int column, int row) const {
    const auto i = static_cast<std::size_t>(column / cells_);
    const auto j = static_cast<std::size_t>(row / cells_);
    const double x = static_cast<double>(column % cells_) / cells_;
    const double y = static_cast<double>(row % cells_) / cells_;
    const auto wide = static_cast<std::size_t>(columns_);
    const std::size_t node = j * wide + i;
    return {{node, node + 1, node + wide, node + wide + 1},
            {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y}};
}

Eigen::Vector2d MapField::at(int column, int row) const {
    const Around near = around(column, row);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < near.nodes.size(); ++k)
        sum += near.weights[k] * values_[near.nodes[k]];
    return sum;
}

/// Calls `use` with the nodes and the coefficients of each second difference along x and along y,
/// and of each mixed difference.
template <typename Use>
void MapField::for_each_difference(Use use) const {
    const auto wide = static_cast<std::size_t>(columns_);
    const auto high = static_cast<std::size_t>(rows_);
    for (std::size_t j = 0; j < high; ++j) {
        for (std::size_t i = 0; i < wide; ++i) {
            const std::size_t n = j * wide + i;
            if (i + 2 < wide) use(std::array{n, n + 1, n + 2}, std::array{1.0, -2.0, 1.0});
            if (j + 2 < high)
                use(std::array{n, n + wide, n + 2 * wide}, std::array{1.0, -2.0, 1.0});
            if (i + 1 < wide && j + 1 < high)
                use(std::array{n, n + 1, n + wide, n + wide + 1}, std::array{1.0, -1.0, -1.0, 1.0});
        }
    }
}

void MapField::add_prior(const std::vector<Eigen::Vector2d>& values,
                         std::vector<Eigen::Vector2d>& product) const {
    constexpr double kWeight = 1 / (kDifference_mm * kDifference_mm);
    for_each_difference([&](const auto& nodes, const auto& coefficients) {
        Eigen::Vector2d difference = Eigen::Vector2d::Zero();
        for (std::size_t k = 0; k < nodes.size(); ++k)
            difference += coefficients[k] * values[nodes[k]];
        for (std::size_t k = 0; k < nodes.size(); ++k)
            product[nodes[k]] += kWeight * coefficients[k] * difference;
    });
}

void MapField::add_prior_diagonal(std::vector<double>& diagonal) const {
    constexpr double kWeight = 1 / (kDifference_mm * kDifference_mm);
    for_each_difference([&](const auto& nodes, const auto& coefficients) {
        for (std::size_t k = 0; k < nodes.size(); ++k)
            diagonal[nodes[k]] += kWeight * coefficients[k] * coefficients[k];
    });
}

}  // namespace dotpose::calibrate

#include "calibrate/map_field.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::calibrate {
namespace {

/// Distance between nodes, in mm. For a wave with a wavelength of 40 mm, the interpolation error is
/// at most 8 % of the amplitude.
constexpr double kNodePitch_mm = 5;

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

MapField MapField::coarser(std::size_t max_nodes) const {
    MapField coarse;
    for (int factor = 1; factor == 1 || coarse.nodes() > max_nodes; ++factor) {
        coarse.cells_ = cells_ * factor;
        coarse.columns_ = (columns_ - 1) / factor + 2;
        coarse.rows_ = (rows_ - 1) / factor + 2;
        coarse.values_.assign(
            static_cast<std::size_t>(coarse.columns_) * static_cast<std::size_t>(coarse.rows_),
            Eigen::Vector2d::Zero());
    }
    return coarse;
}

std::vector<MapField::Around> MapField::nodes_in(const MapField& coarse) const {
    std::vector<Around> result;
    for (int j = 0; j < rows_; ++j) {
        for (int i = 0; i < columns_; ++i)
            result.push_back(coarse.around(i * cells_, j * cells_));
    }
    return result;
}

void MapField::add_prior(const std::vector<Eigen::Vector2d>& values,
                         std::vector<Eigen::Vector2d>& product) const {
    for_each_difference([&](const auto& nodes, const auto& coefficients) {
        Eigen::Vector2d difference = Eigen::Vector2d::Zero();
        for (std::size_t k = 0; k < nodes.size(); ++k)
            difference += coefficients[k] * values[nodes[k]];
        for (std::size_t k = 0; k < nodes.size(); ++k)
            product[nodes[k]] += kDifferenceWeight * coefficients[k] * difference;
    });
}

void MapField::add_prior_diagonal(std::vector<double>& diagonal) const {
    for_each_difference([&](const auto& nodes, const auto& coefficients) {
        for (std::size_t k = 0; k < nodes.size(); ++k)
            diagonal[nodes[k]] += kDifferenceWeight * coefficients[k] * coefficients[k];
    });
}

}  // namespace dotpose::calibrate

// Map field: the slow distortion of a page, interpolated bilinearly between nodes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

class MapField {
  public:
    /// The nodes that surround a place, with their weights.
    struct Around {
        std::array<std::size_t, 4> nodes;
        std::array<double, 4> weights;
    };

    MapField() = default;
    /// A field with the value 0 over a page with these numbers of cells.
    MapField(int columns, int rows, double pitch_mm);

    Around around(int column, int row) const;
    Eigen::Vector2d at(int column, int row) const;

    std::vector<Eigen::Vector2d>& values() { return values_; }
    std::size_t nodes() const { return values_.size(); }

    /// Adds the product of the smoothness prior and `values` to `product`. The prior is a sum of
    /// squared second differences, each divided by its variance.
    void add_prior(const std::vector<Eigen::Vector2d>& values,
                   std::vector<Eigen::Vector2d>& product) const;
    /// Adds the diagonal of the smoothness prior.
    void add_prior_diagonal(std::vector<double>& diagonal) const;

  private:
    template <typename Use>
    void for_each_difference(Use use) const;

    int cells_ = 1;  ///< number of cells between nodes
    int columns_ = 0;
    int rows_ = 0;
    std::vector<Eigen::Vector2d> values_;
};

}  // namespace dotpose::calibrate

// The slowly varying distortion of a page, interpolated bilinearly between nodes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace dotpose::calibrate {

class MapField {
  public:
    /// The four nodes around a dot, with their interpolation weights.
    struct Around {
        std::array<std::size_t, 4> nodes;
        std::array<double, 4> weights;
    };

    MapField() = default;
    /// Creates a field of zeros for a page of `columns` x `rows` dots that are `pitch_mm` apart.
    MapField(int columns, int rows, double pitch_mm);

    Around around(int column, int row) const;
    Eigen::Vector2d at(int column, int row) const;

    std::vector<Eigen::Vector2d>& values() { return values_; }
    std::size_t nodes() const { return values_.size(); }

    /// Multiplies the matrix of the smoothness prior by `values`, and adds the result to `product`.
    /// The prior is a sum of squared second differences, each divided by its variance.
    void add_prior(const std::vector<Eigen::Vector2d>& values,
                   std::vector<Eigen::Vector2d>& product) const;
    /// Adds the diagonal of the smoothness prior's matrix to `diagonal`.
    void add_prior_diagonal(std::vector<double>& diagonal) const;

    /// Returns a field of zeros with at most `max_nodes` nodes that covers all nodes of this field.
    MapField coarser(std::size_t max_nodes) const;
    /// Returns, for each node of this field, the four surrounding nodes of a coarser field.
    std::vector<Around> nodes_in(const MapField& coarse) const;

    /// Prior standard deviation of the second differences of adjacent nodes, in mm. The value is
    /// approximately the maximum second difference of a feed wave with an amplitude of 40 µm and a
    /// wavelength of 50 mm.
    static constexpr double kDifference_mm = 0.016;
    /// Weight of a squared second difference.
    static constexpr double kDifferenceWeight = 1 / (kDifference_mm * kDifference_mm);

    /// Calls `use` for each second difference: along x, along y, and mixed. The arguments are the
    /// nodes of the difference and their coefficients.
    template <typename Use>
    void for_each_difference(Use use) const;

  private:
    int cells_ = 1;  ///< number of cells between adjacent nodes
    int columns_ = 0;
    int rows_ = 0;
    std::vector<Eigen::Vector2d> values_;
};

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

}  // namespace dotpose::calibrate

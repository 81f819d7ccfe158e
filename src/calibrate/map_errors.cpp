#include "calibrate/map_errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "calibrate/map_parts.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;

/// Number of terms of a similarity: shift along x and y, rotation, and scale.
constexpr int kSimilarityTerms = 4;
using SimilarityBlock = Eigen::Matrix<double, kSimilarityTerms, kSimilarityTerms>;
/// Derivatives of the terms of a similarity with respect to the shifts of all coarse nodes.
using SimilarityRows = Eigen::Matrix<double, kSimilarityTerms, Eigen::Dynamic>;

/// Returns the derivatives of the shift at a point with respect to the terms of a similarity.
Eigen::Matrix<double, 2, kSimilarityTerms> shift_terms(const Vector2d& from_centre) {
    Eigen::Matrix<double, 2, kSimilarityTerms> terms;
    terms << 1, 0, -from_centre.y(), from_centre.x(),  //
        0, 1, from_centre.x(), from_centre.y();
    return terms;
}

/// Fits a similarity to the shifts of points, by least squares.
class SimilarityOfShifts {
  public:
    SimilarityOfShifts(const MapDeformation& deformation, const MapGrid& grid,
                       const Vector2d& centre_mm)
        : deformation_(deformation),
          grid_(grid),
          centre_mm_(centre_mm),
          right_(SimilarityRows::Zero(kSimilarityTerms, deformation.unknowns())) {}

    void add(int column, int row) {
        const Vector2d at = grid_.pitch_mm.cwiseProduct(Vector2d(column, row));
        const auto terms = shift_terms(at - centre_mm_);
        normal_ += terms.transpose() * terms;
        const MapField::Around near = deformation_.nodes().around(column, row);
        for (std::size_t k = 0; k < near.nodes.size(); ++k) {
            right_.middleCols<2>(MapDeformation::first_term(near.nodes[k])) +=
                near.weights[k] * terms.transpose();
        }
    }
    SimilarityRows rows() const { return normal_.inverse() * right_; }

  private:
    const MapDeformation& deformation_;
    const MapGrid& grid_;
    Vector2d centre_mm_;
    SimilarityBlock normal_ = SimilarityBlock::Zero();
    SimilarityRows right_;
};

Vector2d middle_of(const MapGrid& grid) {
    return grid.pitch_mm.cwiseProduct(Vector2d(grid.columns - 1, grid.rows - 1)) / 2;
}

/// Returns the similarity fitted to the shifts at all dots that were seen, as a linear function of
/// the shifts of the deformation nodes. If the gauge is `Gauge::fixed`, `fix_gauge` has removed
/// this similarity from the map.
SimilarityRows page_similarity(const MapGrid& grid, const MapSolution& solution,
                               const MapDeformation& deformation) {
    SimilarityOfShifts fit(deformation, grid, middle_of(grid));
    for (std::size_t dot = 0; dot < grid.dots(); ++dot) {
        const auto [column, row] = grid.cell_of(dot);
        if (solution.views[dot] > 0) fit.add(column, row);
    }
    return fit.rows();
}

/// Returns the similarity fitted to the part of the page in a view, as a linear function of the
/// shifts of the deformation nodes. The view is a square whose diagonal is twice `reach_mm`.
SimilarityRows view_similarity(const MapGrid& grid, double reach_mm, const Vector2d& centre_mm,
                               const MapDeformation& deformation) {
    constexpr int kSamples = 9;  // number of samples along each axis
    SimilarityOfShifts fit(deformation, grid, centre_mm);
    const auto index = [&](double centre, int sample, double pitch, int count) {
        const double side = std::numbers::sqrt2 * reach_mm;
        const double at = centre + side * (static_cast<double>(sample) / (kSamples - 1) - 0.5);
        return std::clamp(static_cast<int>(std::lround(at / pitch)), 0, count - 1);
    };
    for (int j = 0; j < kSamples; ++j) {
        for (int i = 0; i < kSamples; ++i) {
            fit.add(index(centre_mm.x(), i, grid.pitch_mm.x(), grid.columns),
                    index(centre_mm.y(), j, grid.pitch_mm.y(), grid.rows));
        }
    }
    return fit.rows();
}

/// Returns a grid over the page with about kTypicalNodes nodes, or fewer if views are large. The
/// distances between nodes are nearly equal along both axes. The covariances of the result are not
/// computed yet.
MapErrorGrid grid_over(const MapGrid& grid, double reach_mm) {
    constexpr double kTypicalNodes = 200;
    const Vector2d size = 2 * middle_of(grid);
    const double distance = std::max(std::sqrt(size.x() * size.y() / kTypicalNodes), reach_mm / 2);
    const auto nodes = [&](double length) {
        return std::clamp(static_cast<int>(std::lround(length / distance)) + 1, 2, 256);
    };
    MapErrorGrid errors{nodes(size.x()), nodes(size.y()), {}};
    errors.covariances.resize(static_cast<std::size_t>(errors.columns) *
                              static_cast<std::size_t>(errors.rows));
    return errors;
}

}  // namespace

MapErrorGrid map_errors(const MapGrid& grid, const MapSolution& solution,
                        const MapDeformation& deformation, Gauge gauge) {
    MapErrorGrid errors = grid_over(grid, solution.reach_mm);
    const Vector2d middle = middle_of(grid);
    const SimilarityRows of_page = page_similarity(grid, solution, deformation);
    for_each_item(errors.covariances.size(), [&](int, std::size_t node) {
        const auto wide = static_cast<std::size_t>(errors.columns);
        const Vector2d centre(
            2 * middle.x() * static_cast<double>(node % wide) / (errors.columns - 1),
            2 * middle.y() * static_cast<double>(node / wide) / (errors.rows - 1));
        MatrixXd rows = view_similarity(grid, solution.reach_mm, centre, deformation).topRows<3>();
        if (gauge == Gauge::fixed) {
            rows.topRows<2>() -= shift_terms(centre - middle) * of_page;
            rows.row(2) -= of_page.row(2);
        }
        errors.covariances[node] = deformation.covariance_of(rows);
    });
    return errors;
}

}  // namespace dotpose::calibrate

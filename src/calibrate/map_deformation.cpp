#include "calibrate/map_deformation.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "calibrate/map_geometry.hpp"
#include "calibrate/map_parts.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Maximum number of coarse nodes. With this number of nodes, factorising the matrix takes 5 Gflop,
/// and storing it takes 46 MB.
constexpr std::size_t kMaxNodes = 800;
/// Number of unknowns of a node: shift along x, shift along y, and change in the displacement.
constexpr int kNodeTerms = 3;
using NodeBlock = Eigen::Matrix<double, kNodeTerms, kNodeTerms>;

/// Returns the derivatives of a dot's offset with respect to the terms of a node, for an
/// interpolation weight of 1.
Eigen::Matrix<double, 2, kNodeTerms> offset_terms(const MapGrid& grid, std::size_t dot) {
    const auto& [dx, dy] = grid.directions[dot];
    Eigen::Matrix<double, 2, kNodeTerms> terms;
    terms << 1, 0, dx, 0, 1, dy;
    return terms;
}

/// Returns the coarse nodes around a dot.
MapField::Around around_dot(const MapField& nodes, const MapGrid& grid, std::size_t dot) {
    const auto [column, row] = grid.cell_of(dot);
    return nodes.around(column, row);
}

}  // namespace

Eigen::Index MapDeformation::first_term(std::size_t node) {
    return kNodeTerms * static_cast<Eigen::Index>(node);
}

MapDeformation::MapDeformation(const MapGrid& grid, const EarlierOffsets& earlier,
                               const std::vector<MapObservation>& observations,
                               const MapSolution& solution)
    : nodes_(solution.field.coarser(kMaxNodes)), field_nodes_(solution.field.nodes_in(nodes_)) {
    const Eigen::Index unknowns = first_term(nodes_.nodes());
    MatrixXd matrix = MatrixXd::Zero(unknowns, unknowns);
    add_frames(grid, observations, solution, matrix);
    add_dots(grid, earlier, solution, matrix);
    add_smoothness(solution.field, matrix);
    // The observations do not determine the shift and rotation of the whole page, so the matrix may
    // be singular. The added term makes it invertible.
    matrix.diagonal().array() += 1e-9 * matrix.diagonal().maxCoeff();
    equations_.compute(matrix);
}

MapDeformation::FrameEquations MapDeformation::equations_of(
    const MapGrid& grid, const std::vector<MapObservation>& observations,
    const MapSolution& solution, const MapFrame& frame) const {
    FrameEquations result;
    std::vector<std::uint32_t>& nodes = result.follower.nodes;
    for (std::size_t k = 0; k < frame.count; ++k) {
        const MapField::Around near =
            around_dot(nodes_, grid, observations[frame.first + k].index());
        for (const std::size_t node : near.nodes) {
            if (std::ranges::find(nodes, node) == nodes.end())
                nodes.push_back(static_cast<std::uint32_t>(node));
        }
    }
    const MapView view(grid, frame, solution.reach_mm);
    const Eigen::Index count = first_term(nodes.size());
    FrameBlock block = FrameBlock::Zero();
    Eigen::Matrix<double, kFrameTerms, Eigen::Dynamic> right =
        Eigen::Matrix<double, kFrameTerms, Eigen::Dynamic>::Zero(kFrameTerms, count);
    result.matrix = MatrixXd::Zero(count, count);
    for (std::size_t k = 0; k < frame.count; ++k) {
        const MapObservation& seen = observations[frame.first + k];
        if (seen.is_outlier()) continue;
        const auto derivatives = view.terms(seen).derivatives();
        block.noalias() += derivatives.transpose() * derivatives;
        const auto offset = offset_terms(grid, seen.index());
        const Eigen::Matrix<double, kFrameTerms, kNodeTerms> mixed =
            derivatives.transpose() * (view.page_from_camera().transpose() * offset);
        const NodeBlock square = offset.transpose() * offset;
        const MapField::Around near = around_dot(nodes_, grid, seen.index());
        std::array<Eigen::Index, 4> at{};
        for (std::size_t i = 0; i < 4; ++i)
            at[i] = kNodeTerms * (std::ranges::find(nodes, near.nodes[i]) - nodes.begin());
        for (std::size_t i = 0; i < 4; ++i) {
            right.middleCols<kNodeTerms>(at[i]) += near.weights[i] * mixed;
            for (std::size_t j = 0; j < 4; ++j)
                result.matrix.block<kNodeTerms, kNodeTerms>(at[i], at[j]) +=
                    near.weights[i] * near.weights[j] * square;
        }
    }
    const double variance = solution.noise_mm * solution.noise_mm;
    add_view_prior(solution, variance, block);
    const MatrixXd terms = block.llt().solve(right);
    result.matrix -= right.transpose() * terms;
    result.matrix /= variance;
    result.follower.terms = terms.cast<float>();
    return result;
}

void MapDeformation::add_frames(const MapGrid& grid,
                                const std::vector<MapObservation>& observations,
                                const MapSolution& solution, MatrixXd& matrix) {
    const std::vector<MapFrame>& frames = solution.frames;
    followers_.resize(frames.size());
    // Computes the matrices in batches, because the matrices of all frames together would need more
    // memory than the observations.
    constexpr std::size_t kBatch = 256;
    for (std::size_t first = 0; first < frames.size(); first += kBatch) {
        std::vector<FrameEquations> batch(std::min(kBatch, frames.size() - first));
        for_each_item(batch.size(), [&](int, std::size_t k) {
            batch[k] = equations_of(grid, observations, solution, frames[first + k]);
        });
        for (std::size_t k = 0; k < batch.size(); ++k) {
            const std::vector<std::uint32_t>& nodes = batch[k].follower.nodes;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                for (std::size_t j = 0; j < nodes.size(); ++j) {
                    matrix.block<kNodeTerms, kNodeTerms>(first_term(nodes[i]),
                                                         first_term(nodes[j])) +=
                        batch[k].matrix.block<kNodeTerms, kNodeTerms>(first_term(i), first_term(j));
                }
            }
            followers_[first + k] = std::move(batch[k].follower);
        }
    }
}

void MapDeformation::add_dots(const MapGrid& grid, const EarlierOffsets& earlier,
                              const MapSolution& solution, MatrixXd& matrix) const {
    const double weight = 1 / (solution.noise_mm * solution.noise_mm);
    const double prior_weight = 1 / (solution.jitter_mm * solution.jitter_mm);
    for (std::size_t dot = 0; dot < grid.dots(); ++dot) {
        const auto offset = offset_terms(grid, dot);
        NodeBlock square = NodeBlock::Zero();
        if (!earlier.views.empty())
            square = weight * static_cast<double>(earlier.views[dot]) * offset.transpose() * offset;
        // The prior applies to the difference between the offset and the field. A shift changes the
        // offset and the field equally, so only a change in the displacement contributes.
        square(2, 2) += prior_weight;
        const MapField::Around near = around_dot(nodes_, grid, dot);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 4; ++j) {
                matrix.block<kNodeTerms, kNodeTerms>(first_term(near.nodes[i]),
                                                     first_term(near.nodes[j])) +=
                    near.weights[i] * near.weights[j] * square;
            }
        }
    }
}

void MapDeformation::add_smoothness(const MapField& field, MatrixXd& matrix) const {
    // A second difference depends on at most 4 nodes of the field, and each node of the field
    // depends on 4 coarse nodes.
    field.for_each_difference([&](const auto& fine, const auto& coefficients) {
        std::array<std::pair<Eigen::Index, double>, 16> terms;
        std::size_t count = 0;
        for (std::size_t k = 0; k < fine.size(); ++k) {
            const MapField::Around& near = field_nodes_[fine[k]];
            for (std::size_t i = 0; i < 4; ++i)
                terms[count++] = {first_term(near.nodes[i]), coefficients[k] * near.weights[i]};
        }
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < count; ++j) {
                matrix.block<2, 2>(terms[i].first, terms[j].first).diagonal().array() +=
                    MapField::kDifferenceWeight * terms[i].second * terms[j].second;
            }
        }
    });
}

void MapDeformation::add_solution(const MapUnknowns& residual, MapUnknowns& result) const {
    VectorXd right = VectorXd::Zero(first_term(nodes_.nodes()));
    for (std::size_t f = 0; f < followers_.size(); ++f) {
        const auto& [nodes, terms] = followers_[f];
        const Eigen::VectorXf own = terms.transpose() * residual.frames[f].cast<float>();
        for (std::size_t i = 0; i < nodes.size(); ++i)
            right.segment<kNodeTerms>(first_term(nodes[i])) +=
                own.segment<kNodeTerms>(first_term(i)).cast<double>();
    }
    for (std::size_t k = 0; k < field_nodes_.size(); ++k) {
        const auto& [nodes, weights] = field_nodes_[k];
        for (std::size_t i = 0; i < nodes.size(); ++i)
            right.segment<2>(first_term(nodes[i])) += weights[i] * residual.field[k];
    }
    const VectorXd values = equations_.solve(right);
    for (std::size_t f = 0; f < followers_.size(); ++f) {
        const auto& [nodes, terms] = followers_[f];
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            result.frames[f] += terms.middleCols<kNodeTerms>(first_term(i)).cast<double>() *
                                values.segment<kNodeTerms>(first_term(nodes[i]));
        }
    }
    for (std::size_t k = 0; k < field_nodes_.size(); ++k) {
        const auto& [nodes, weights] = field_nodes_[k];
        for (std::size_t i = 0; i < nodes.size(); ++i)
            result.field[k] += weights[i] * values.segment<2>(first_term(nodes[i]));
    }
}

Eigen::Matrix3d MapDeformation::covariance_of(
    const Eigen::Matrix<double, 3, Eigen::Dynamic>& functions) const {
    // The matrix of the equations is L L^T, so the covariance is half^T half, where half = L^-1
    // functions^T.
    const Eigen::Matrix<double, Eigen::Dynamic, 3> half =
        equations_.matrixL().solve(functions.transpose());
    return half.transpose() * half;
}

}  // namespace dotpose::calibrate

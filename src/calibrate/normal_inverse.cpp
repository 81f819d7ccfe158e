#include "calibrate/normal_inverse.hpp"

#include <algorithm>

#include <ceres/crs_matrix.h>

#include "calibrate/least_squares.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Elements of J^T J in the rows of one unshared parameter block.
struct UnsharedBlock {
    Index begin;           ///< first column of the block
    MatrixXd with_shared;  ///< products with the shared columns
    MatrixXd squares;      ///< products within the block
};

/// The matrix J^T J. The products of different unshared blocks are 0 and are not stored.
struct Normal {
    ceres::CRSMatrix jacobian;  ///< columns of the shared blocks come first
    MatrixXd shared;
    std::vector<UnsharedBlock> unshared;
    /// For each column after the shared columns, index of its block in `unshared`.
    std::vector<std::size_t> block_of_column;
};

/// Calls `work(column, value)` for each stored element of one row of the Jacobian.
template <typename Work>
void for_each_in_row(const ceres::CRSMatrix& matrix, std::size_t row, Work work) {
    for (auto i = static_cast<std::size_t>(matrix.rows[row]);
         i < static_cast<std::size_t>(matrix.rows[row + 1]); ++i)
        work(Index{matrix.cols[i]}, matrix.values[i]);
}

void add_squares(Normal& normal) {
    const Index size = normal.shared.rows();
    const ceres::CRSMatrix& jacobian = normal.jacobian;
    for (std::size_t row = 0; row + 1 < jacobian.rows.size(); ++row) {
        for_each_in_row(jacobian, row, [&](Index a, double value_a) {
            for_each_in_row(jacobian, row, [&](Index b, double value_b) {
                const double product = value_a * value_b;
                if (a < size && b < size) normal.shared(a, b) += product;
                if (a < size) return;
                UnsharedBlock& block =
                    normal.unshared[normal.block_of_column[static_cast<std::size_t>(a - size)]];
                if (b < size) block.with_shared(a - block.begin, b) += product;
                if (b >= size) block.squares(a - block.begin, b - block.begin) += product;
            });
        });
    }
}

Normal normal_of(ceres::Problem& problem, const std::vector<double*>& shared) {
    std::vector<double*> blocks;
    problem.GetParameterBlocks(&blocks);
    std::erase_if(blocks, [&](double* block) { return std::ranges::count(shared, block) > 0; });
    Index size = 0;
    for (double* block : shared)
        size += problem.ParameterBlockSize(block);
    Normal normal;
    normal.shared = MatrixXd::Zero(size, size);
    for (double* block : blocks) {
        const Index width = problem.ParameterBlockSize(block);
        const Index begin = size + static_cast<Index>(normal.block_of_column.size());
        normal.block_of_column.insert(normal.block_of_column.end(), static_cast<std::size_t>(width),
                                      normal.unshared.size());
        normal.unshared.push_back(
            {begin, MatrixXd::Zero(width, size), MatrixXd::Zero(width, width)});
    }
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = shared;
    options.parameter_blocks.insert(options.parameter_blocks.end(), blocks.begin(), blocks.end());
    problem.Evaluate(options, nullptr, nullptr, nullptr, &normal.jacobian);
    add_squares(normal);
    return normal;
}

/// Returns the negated derivative of the optimal values of a block with respect to the shared
/// parameters.
MatrixXd negated_gain(const UnsharedBlock& block) {
    return inverse_of(block.squares) * block.with_shared;
}

MatrixXd inverse_of_shared(const Normal& normal) {
    MatrixXd left = normal.shared;
    for (const UnsharedBlock& block : normal.unshared)
        left -= block.with_shared.transpose() * negated_gain(block);
    return inverse_of(left);
}

}  // namespace

MatrixXd normal_inverse(ceres::Problem& problem, const std::vector<double*>& shared) {
    return inverse_of_shared(normal_of(problem, shared));
}

MatrixXd normal_gain(ceres::Problem& problem, const std::vector<double*>& shared) {
    const Normal normal = normal_of(problem, shared);
    const Index size = normal.shared.rows();
    std::vector<MatrixXd> negated_gains;
    for (const UnsharedBlock& block : normal.unshared)
        negated_gains.push_back(negated_gain(block));
    MatrixXd left = MatrixXd::Zero(size, normal.jacobian.num_rows);
    for (Index row = 0; row < left.cols(); ++row) {
        for_each_in_row(
            normal.jacobian, static_cast<std::size_t>(row), [&](Index column, double value) {
                if (column < size) {
                    left(column, row) += value;
                    return;
                }
                const auto block = normal.block_of_column[static_cast<std::size_t>(column - size)];
                left.col(row) -=
                    value *
                    negated_gains[block].row(column - normal.unshared[block].begin).transpose();
            });
    }
    return inverse_of_shared(normal) * left;
}

}  // namespace dotpose::calibrate

#include "calibrate/normal_inverse.hpp"

#include <algorithm>

#include <Eigen/Cholesky>
#include <ceres/crs_matrix.h>

namespace dotpose::calibrate {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The part of J^T J of a block that is not shared.
struct Own {
    Index begin;  ///< its first column
    MatrixXd with_shared;
    MatrixXd with_itself;
};

/// Of one scale, so that no precision is lost.
MatrixXd inverse_of(const MatrixXd& normal) {
    const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseMax(1e-30).cwiseInverse();
    const MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    const MatrixXd inverse = scaled.ldlt().solve(MatrixXd::Identity(normal.rows(), normal.cols()));
    return scale.asDiagonal() * inverse * scale.asDiagonal();
}

}  // namespace

MatrixXd normal_inverse(ceres::Problem& problem, const std::vector<double*>& shared) {
    std::vector<double*> blocks;
    problem.GetParameterBlocks(&blocks);
    std::erase_if(blocks, [&](double* block) { return std::ranges::count(shared, block) > 0; });
    Index size = 0;
    for (double* block : shared)
        size += problem.ParameterBlockSize(block);
    std::vector<Own> owns;
    std::vector<std::size_t> own_of_column;
    for (double* block : blocks) {
        const Index width = problem.ParameterBlockSize(block);
        own_of_column.insert(own_of_column.end(), static_cast<std::size_t>(width), owns.size());
        owns.push_back({size + static_cast<Index>(own_of_column.size()) - width,
                        MatrixXd::Zero(width, size), MatrixXd::Zero(width, width)});
    }
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = shared;
    options.parameter_blocks.insert(options.parameter_blocks.end(), blocks.begin(), blocks.end());
    ceres::CRSMatrix rows;
    problem.Evaluate(options, nullptr, nullptr, nullptr, &rows);

    MatrixXd normal = MatrixXd::Zero(size, size);
    for (std::size_t row = 0; row + 1 < rows.rows.size(); ++row) {
        for (auto i = static_cast<std::size_t>(rows.rows[row]);
             i < static_cast<std::size_t>(rows.rows[row + 1]); ++i) {
            for (auto j = static_cast<std::size_t>(rows.rows[row]);
                 j < static_cast<std::size_t>(rows.rows[row + 1]); ++j) {
                const double product = rows.values[i] * rows.values[j];
                const Index a = rows.cols[i];
                const Index b = rows.cols[j];
                if (a < size && b < size) normal(a, b) += product;
                if (a < size) continue;
                Own& own = owns[own_of_column[static_cast<std::size_t>(a - size)]];
                if (b < size) own.with_shared(a - own.begin, b) += product;
                if (b >= size) own.with_itself(a - own.begin, b - own.begin) += product;
            }
        }
    }
    for (const Own& own : owns)
        normal -= own.with_shared.transpose() * inverse_of(own.with_itself) * own.with_shared;
    return inverse_of(normal);
}

}  // namespace dotpose::calibrate

// Least squares of a plane with perspective, shear and lens, in single precision: the normal
// equations.
#pragma once

#include <cstring>

#include "core/fit/projections.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Residuals of four points, in spacings, with their weights. Points of weight 0 are left out.
struct Residuals {
    FourVecs offset;
    Four weight;
};

/// Weighted sums over the points and their residuals. They are the elements of the normal
/// equations.
class PlaneSumsFloat {
  public:
    void add(const FourVecs& places, const Residuals& residuals);
    FitSums all() const;

  private:
    /// Negated number of points, because a vector comparison yields -1 for true.
    FourInts less_points_{};
    std::array<Four, 4> places_{};
    std::array<Four, 3> residuals_{};  ///< includes the squared residuals
};

/// The normal equations M p = right, solved by Cholesky's decomposition M = L L^T.
class PlaneNormalFloat {
  public:
    PlaneNormalFloat() = default;
    explicit PlaneNormalFloat(const FitSums& sums);

    /// Replaces M by L. Leaves out parameters that the points do not determine. Returns false if
    /// one of the first four parameters is not determined.
    bool decompose();

    /// Returns L^-1 column. The inner product of two such columns a and b is a . M^-1 . b.
    Parameters whitened(const Parameters& column) const;
    /// Returns L^-T column.
    Parameters unwhitened(const Parameters& column) const;
    /// Returns L^T column.
    Parameters times_transposed(const Parameters& column) const;

    /// Returns an element of L.
    float factor(std::size_t row, std::size_t column) const { return m_[column].at(row); }

    const Parameters& right() const { return right_; }
    float squared_residuals() const { return squared_residuals_; }
    int points() const { return points_; }
    /// Returns true if the points determine the parameter. Requires `decompose`.
    bool determines(std::size_t parameter) const { return m_[parameter].at(parameter) > 0; }

  private:
    /// A column of M or L, stored in whole vectors. Columns of L are 0 above the diagonal.
    class Column {
      public:
        Column() = default;
        explicit Column(const Parameters& numbers) {
            std::memcpy(parts_.data(), numbers.data(), sizeof numbers);
        }
        float at(std::size_t row) const { return parts_[row / 4][row % 4]; }
        void set(std::size_t row, float number) { parts_[row / 4][row % 4] = number; }
        void divide(float by) {
            for (Four& part : parts_)
                part /= by;
        }
        void subtract(const Column& column, float times) {
            for (std::size_t i = 0; i < parts_.size(); ++i)
                parts_[i] -= column.parts_[i] * times;
        }
        void clear_before(std::size_t row) {
            for (std::size_t i = 0; i < row; ++i)
                set(i, 0);
        }
        float inner(const Column& other) const {
            Four sums{};
            for (std::size_t i = 0; i < parts_.size(); ++i)
                sums += parts_[i] * other.parts_[i];
            return (sums[0] + sums[1]) + (sums[2] + sums[3]);
        }

      private:
        std::array<Four, 3> parts_{};
    };

    void leave_out(std::size_t parameter);
    void set_rows(const std::array<Parameters, kPoseParameters>& lower);

    std::array<Column, kPoseParameters>
        m_{};  ///< columns of M on and below the diagonal; columns of L after `decompose`
    Parameters right_{};
    float squared_residuals_ = 0;
    int points_ = 0;
};

}  // namespace dotpose::core

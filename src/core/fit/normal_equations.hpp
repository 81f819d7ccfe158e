// Normal equations: least squares in single precision, solved by Cholesky decomposition.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/math/vectors.hpp"

namespace dotpose::core {

/// The normal equations M p = right for N parameters p. `decompose` replaces M with its Cholesky
/// factor L, where M = L L^T.
template <std::size_t N>
class NormalEquations {
  public:
    using Vector = std::array<float, N>;

    /// Sets an element of M on or below the diagonal.
    void set(std::size_t row, std::size_t column, float number) {
        columns_[column].set(row, number);
    }
    /// Adds an equation with the given residual and weight. `derivatives` contains the derivatives
    /// of the modelled quantity with respect to the parameters.
    void add(const Vector& derivatives, float residual, float weight) {
        const Column all(derivatives);
        for (std::size_t i = 0; i < N; ++i) {
            columns_[i].subtract(all, -weight * derivatives[i]);
            right_[i] += weight * derivatives[i] * residual;
        }
    }
    /// Adds to an element of M on or below the diagonal.
    void add_to(std::size_t row, std::size_t column, float number) {
        set(row, column, columns_[column].at(row) + number);
    }
    void add_to_right(std::size_t row, float number) { right_[row] += number; }
    void set_right(const Vector& right) { right_ = right; }
    const Vector& right() const { return right_; }

    /// Multiplies the diagonal of M by a factor (Marquardt 1963).
    void scale_diagonal(float by) {
        for (std::size_t i = 0; i < N; ++i)
            columns_[i].set(i, columns_[i].at(i) * by);
    }

    /// Replaces M with L. Excludes poorly determined parameters: a parameter is excluded if the
    /// elimination of the preceding parameters reduces its diagonal element to at most
    /// `min_determined` times the original value. Returns false if one of the first `required`
    /// parameters is excluded.
    bool decompose(float min_determined, std::size_t required) {
        Vector minima;
        for (std::size_t i = 0; i < N; ++i)
            minima[i] = min_determined * columns_[i].at(i);
        for (std::size_t i = 0; i < N; ++i) {
            Column& column = columns_[i];
            // The condition is also true for a parameter that occurs in no equation, because its
            // diagonal element is 0.
            if (!(column.at(i) > minima[i])) {
                if (i < required) return false;
                leave_out(i);
                continue;
            }
            const float root = std::sqrt(column.at(i));
            column.divide(root);
            column.set(i, root);
            column.clear_before(i);
            for (std::size_t k = i + 1; k < N; ++k)
                columns_[k].subtract(column, column.at(k));
        }
        return true;
    }

    // The functions below may be called only after `decompose`.

    /// Returns true if `decompose` did not exclude the parameter.
    bool determines(std::size_t parameter) const { return columns_[parameter].at(parameter) > 0; }
    /// Returns an element of L.
    float factor(std::size_t row, std::size_t column) const { return columns_[column].at(row); }

    /// Returns L^-1 `vector`. The inner product of whitened(a) and whitened(b) is a . M^-1 b.
    Vector whitened(const Vector& vector) const {
        Column rest(vector);
        Vector result;
        for (std::size_t i = 0; i < N; ++i) {
            result[i] = determines(i) ? rest.at(i) / columns_[i].at(i) : 0;
            rest.subtract(columns_[i], result[i]);
        }
        return result;
    }
    /// Returns L^-T `vector`.
    Vector unwhitened(const Vector& vector) const {
        // The most recently computed element is used last, so the processor can compute the other
        // products while it waits for this element.
        Vector result{};
        for (std::size_t i = N; i-- > 0;) {
            float rest = vector[i];
            for (std::size_t k = N; --k > i;)
                rest -= columns_[i].at(k) * result[k];
            result[i] = determines(i) ? rest / columns_[i].at(i) : 0;
        }
        return result;
    }
    /// Returns L^T `vector`.
    Vector times_transposed(const Vector& vector) const {
        const Column other(vector);
        Vector result;
        for (std::size_t i = 0; i < N; ++i)
            result[i] = columns_[i].inner(other);
        return result;
    }
    /// Returns the least-squares solution M^-1 `right`.
    Vector solution() const { return unwhitened(whitened(right_)); }

  private:
    /// A column of M or L, stored four elements at a time. Columns of L are 0 above the diagonal.
    class Column {
      public:
        Column() = default;
        explicit Column(const Vector& numbers) {
            for (std::size_t i = 0; i < N; ++i)
                set(i, numbers[i]);
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
        std::array<Four, (N + 3) / 4> parts_{};
    };

    void leave_out(std::size_t parameter) {
        for (std::size_t i = 0; i < parameter; ++i)
            columns_[i].set(parameter, 0);
        columns_[parameter] = {};
    }

    std::array<Column, N> columns_{};
    Vector right_{};
};

}  // namespace dotpose::core

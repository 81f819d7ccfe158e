/// Linear least squares by Givens rotations, applied row by row. The result is as accurate as that
/// of a QR decomposition of all rows, but the rows are not stored.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace dotpose::files {

/// Accumulates equations row . x = right with `kUnknowns` unknowns.
template <std::size_t kUnknowns>
class LeastSquares {
  public:
    using Vector = std::array<double, kUnknowns>;

    void add(Vector row, double right) {
        for (std::size_t i = 0; i < kUnknowns; ++i) {
            if (row[i] == 0) continue;
            // Givens rotation that sets row[i] to 0.
            const double radius = std::hypot(rows_[i][i], row[i]);
            const double c = rows_[i][i] / radius;
            const double s = row[i] / radius;
            for (std::size_t j = i; j < kUnknowns; ++j)
                rotate(c, s, rows_[i][j], row[j]);
            rotate(c, s, rights_[i], right);
        }
    }

    /// Returns the solution that minimises the sum of squared residuals. The added rows must
    /// determine all unknowns.
    Vector solve() const {
        Vector x{};
        for (std::size_t i = kUnknowns; i-- > 0;) {
            double rest = rights_[i];
            for (std::size_t j = i + 1; j < kUnknowns; ++j)
                rest -= rows_[i][j] * x[j];
            x[i] = rest / rows_[i][i];
        }
        return x;
    }

  private:
    static void rotate(double c, double s, double& first, double& second) {
        const double turned = c * first + s * second;
        second = c * second - s * first;
        first = turned;
    }

    std::array<Vector, kUnknowns> rows_{};  ///< upper triangular
    Vector rights_{};
};

}  // namespace dotpose::files

#include "core/fit/plane_fit_int64.hpp"

namespace dotpose::core {
namespace {

/// Fraction bits of the reduced maps. Targets in 2^-16 spacings over points in 2^-8 px, times 2^16,
/// give slopes in 2^-24 spacings per px.
constexpr int kBits = 16;

/// Solves a symmetric system of two or three equations by Cramer's rule. Solutions are scaled by
/// 2^30.
class SmallSystem {
  public:
    using Matrix = std::array<std::array<std::int64_t, 3>, 3>;
    using Column = std::array<std::int64_t, 3>;

    SmallSystem(Matrix matrix, Column right, std::size_t size) : size_(size) {
        std::int64_t largest = 1;
        for (std::size_t i = 0; i < size; ++i)
            largest = std::max(largest, matrix[i][i]);
        // With entries of 19 bits, the determinant of three rows fits in 60 bits.
        int shift = 0;
        while (largest >> shift >= std::int64_t{1} << 19)
            ++shift;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                const bool inside = i < size && j < size;
                matrix_[i][j] = inside ? matrix[i][j] >> shift : (i == j ? 1 : 0);
            }
            right_[i] = i < size ? right[i] >> shift : 0;
        }
    }

    bool solve(std::array<std::int32_t, 3>& solution_q30) const {
        const std::int64_t whole = determinant(matrix_);
        const std::int64_t diagonal = matrix_[0][0] * matrix_[1][1] * matrix_[2][2];
        // Regressors that are nearly proportional do not determine their terms.
        if (whole <= 0 || whole < diagonal / 4096) return false;
        for (std::size_t k = 0; k < size_; ++k) {
            Matrix replaced = matrix_;
            for (std::size_t i = 0; i < 3; ++i)
                replaced[i][k] = right_[i];
            const std::int64_t part = determinant(replaced);
            // A term larger than 1/2 would place the horizon within the image.
            if (part > whole / 2 || part < -whole / 2) return false;
            solution_q30[k] =
                part < 0 ? -scaled_quotient(-part, whole, 30) : scaled_quotient(part, whole, 30);
        }
        return true;
    }

  private:
    static std::int64_t determinant(const Matrix& m) {
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    }

    std::size_t size_;
    Matrix matrix_{};
    Column right_{};
};

}  // namespace

PlaneFitInt64::PlaneFitInt64(const PlaneFromImage& estimate, int reach_px, Terms terms)
    : centre_q8_(estimate.centre_q8), at_centre_q16_(estimate.at_centre_q16), terms_(terms) {
    while (1 << scale_ < reach_px)
        ++scale_;
}

std::array<FixedVec, 4> PlaneFitInt64::regressors(FixedVec p, FixedVec target_q16) const {
    const FixedVec target = target_q16 - at_centre_q16_;
    const auto times = [&](std::int64_t factor, int bits) {
        return FixedVec{shift_rounded(factor * target.x, bits),
                        shift_rounded(factor * target.y, bits)};
    };
    // x / 2^scale has 8 + scale fraction bits. The shift gives r^2 / 2^(2 scale) the same number of
    // fraction bits.
    const int bits = 8 + scale_;
    return {target, times(p.x, bits), times(p.y, bits), times(squared(p) >> bits, bits)};
}

void PlaneFitInt64::add(FixedVec image_point_q8, FixedVec target_q16) {
    const FixedVec p = image_point_q8 - centre_q8_;
    const auto columns = regressors(p, target_q16);
    for (std::size_t k = 0; k <= extra(); ++k)
        fits_[k].add(p, columns[k]);
}

bool PlaneFitInt64::reduce() {
    for (std::size_t k = 0; k <= extra(); ++k) {
        if (!fits_[k].solve(kBits, maps_[k])) return false;
    }
    return true;
}

void PlaneFitInt64::add_residual(FixedVec image_point_q8, FixedVec target_q16) {
    if (extra() == 0) return;
    const FixedVec p = image_point_q8 - centre_q8_;
    auto residuals = regressors(p, target_q16);
    for (std::size_t k = 0; k <= extra(); ++k) {
        const AffineMap& m = maps_[k];
        const auto fitted = [&](std::int64_t offset, std::int32_t dx, std::int32_t dy) {
            return shift_rounded(offset + std::int64_t{dx} * p.x + std::int64_t{dy} * p.y, kBits);
        };
        residuals[k] = residuals[k] - FixedVec{fitted(m.offset_x, m.dx.x, m.dy.x),
                                               fitted(m.offset_y, m.dx.y, m.dy.y)};
    }
    for (std::size_t i = 0; i < extra(); ++i) {
        for (std::size_t j = 0; j < extra(); ++j) {
            normal_[i][j] += dot(residuals[i + 1], residuals[j + 1]);
        }
        right_[i] += dot(residuals[i + 1], residuals[0]);
    }
}

bool PlaneFitInt64::solve(PlaneFromImage& plane) const {
    // The equation is target * (1 + sum of terms) = affine map. This affine map is the affine map
    // of the target minus the sum of the affine maps of the regressors, each multiplied by its
    // term.
    std::array<std::int32_t, kExtra> terms_q30{};
    if (extra() > 0 && !SmallSystem(normal_, right_, extra()).solve(terms_q30)) return false;
    std::array<std::int64_t, 6> sum{maps_[0].offset_x, maps_[0].offset_y, maps_[0].dx.x,
                                    maps_[0].dx.y,     maps_[0].dy.x,     maps_[0].dy.y};
    for (std::size_t k = 0; k < extra(); ++k) {
        const AffineMap& m = maps_[k + 1];
        const std::array<std::int64_t, 6> part{m.offset_x, m.offset_y, m.dx.x,
                                               m.dx.y,     m.dy.x,     m.dy.y};
        for (std::size_t i = 0; i < sum.size(); ++i) {
            // Offsets have up to 41 bits and need less resolution than slopes, which have up to 31
            // bits.
            const int coarser = i < 2 ? 11 : 0;
            sum[i] -= (part[i] >> coarser) * terms_q30[k] >> (30 - coarser);
        }
    }
    plane.centre_q8 = centre_q8_;
    plane.perspective_q30 = {-(terms_q30[0] >> scale_), -(terms_q30[1] >> scale_)};
    plane.lens_q40 = static_cast<std::int32_t>(-(std::int64_t{terms_q30[2]} << 10) >> (2 * scale_));
    // (at + du x + dv y) / divisor equals at + (du - at * perspective.x) x + ..., except for the
    // lens term of the remaining `at`. The next fit reduces this error.
    const FixedVec at{shift_rounded(sum[0], kBits), shift_rounded(sum[1], kBits)};
    plane.at_centre_q16 = at_centre_q16_ + at;
    const auto slope = [&](std::int64_t own, std::int32_t at_q16, std::int32_t perspective_q30) {
        return static_cast<std::int32_t>(own - ((std::int64_t{at_q16} * perspective_q30) >> 22));
    };
    const FixedVec& tilt = plane.perspective_q30;
    plane.du_q24 = {slope(sum[2], at.x, tilt.x), slope(sum[3], at.y, tilt.x)};
    plane.dv_q24 = {slope(sum[4], at.x, tilt.y), slope(sum[5], at.y, tilt.y)};
    return true;
}

PlaneFromImage between(const PlaneFromImage& from, const PlaneFromImage& to,
                       std::int64_t weight_q8) {
    const auto value = [&](std::int64_t a, std::int64_t b) {
        return static_cast<std::int32_t>(a + ((b - a) * weight_q8 >> 8));
    };
    const auto vector = [&](FixedVec a, FixedVec b) {
        return FixedVec{value(a.x, b.x), value(a.y, b.y)};
    };
    return {from.centre_q8,
            vector(from.at_centre_q16, to.at_centre_q16),
            vector(from.du_q24, to.du_q24),
            vector(from.dv_q24, to.dv_q24),
            vector(from.perspective_q30, to.perspective_q30),
            value(from.lens_q40, to.lens_q40)};
}

}  // namespace dotpose::core

#include "core/pose/covariance.hpp"

#include <array>
#include <cmath>

namespace dotpose::core {
namespace {

/// Parameters of a plane: at_centre.x, du.x, dv.x, the same for y, perspective.x and .y, lens.
constexpr std::size_t kMost = 9;
using Row = std::array<float, kMost>;
/// Derivatives of the two coordinates of a plane point by the parameters.
using Jacobian = std::array<Row, 2>;

/// Lengths in the image are counted in units of 2^kUnit_bits px, so that the derivatives by all
/// parameters are of like size and single precision suffices.
constexpr int kUnit_bits = 7;

Jacobian jacobian(const PlaneFromImage& plane, Vec image_point_q8) {
    const Vec p = image_point_q8 - plane.centre_q8;
    constexpr float kUnits_per_q8 = 1.0F / static_cast<float>(256 << kUnit_bits);
    const float x = static_cast<float>(p.x) * kUnits_per_q8;
    const float y = static_cast<float>(p.y) * kUnits_per_q8;
    const float shrink = 1073741824.0F / static_cast<float>(divisor_q30(plane, p));
    const Vec from_centre = plane_point_q16(plane, image_point_q8) - plane.at_centre_q16;
    const float qx = static_cast<float>(from_centre.x) / 65536.0F;
    const float qy = static_cast<float>(from_centre.y) / 65536.0F;
    const float r2 = x * x + y * y;
    const auto row = [&](float q) {
        return std::array{-q * x * shrink, -q * y * shrink, -q * r2 * shrink};
    };
    const auto a = row(qx);
    const auto b = row(qy);
    return {Row{1, x * shrink, y * shrink, 0, 0, 0, a[0], a[1], a[2]},
            Row{0, 0, 0, 1, x * shrink, y * shrink, b[0], b[1], b[2]}};
}

/// Normal equations of the fit, and their solution by Cholesky's decomposition.
class Normal {
  public:
    explicit Normal(std::size_t size) : size_(size) {}

    void add(const Jacobian& rows) {
        for (const Row& row : rows) {
            for (std::size_t i = 0; i < size_; ++i) {
                for (std::size_t j = 0; j <= i; ++j)
                    m_[i][j] += row[i] * row[j];
            }
        }
    }

    bool decompose() {
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t j = 0; j <= i; ++j) {
                float sum = m_[i][j];
                for (std::size_t k = 0; k < j; ++k)
                    sum -= m_[i][k] * m_[j][k];
                if (i != j) {
                    m_[i][j] = sum / m_[j][j];
                } else if (sum > 0) {
                    m_[i][i] = std::sqrt(sum);
                } else {
                    return false;
                }
            }
        }
        return true;
    }

    /// L^-1 row: the inner product of two such is row_a . M^-1 . row_b.
    Row whitened(Row row) const {
        for (std::size_t i = 0; i < size_; ++i) {
            for (std::size_t k = 0; k < i; ++k)
                row[i] -= m_[i][k] * row[k];
            row[i] /= m_[i][i];
        }
        return row;
    }

    float inner(const Row& a, const Row& b) const {
        float sum = 0;
        for (std::size_t i = 0; i < size_; ++i)
            sum += a[i] * b[i];
        return sum;
    }

  private:
    std::size_t size_;
    std::array<Row, kMost> m_{};
};

/// Derivatives, by the parameters, of the direction in which a step in the image leads.
Row direction_gradient(const PlaneFromImage& plane, Vec reference_q8, Vec step_q8) {
    const Vec behind = reference_q8 - step_q8;
    const Vec ahead = reference_q8 + step_q8;
    const Vec step_q16 = plane_point_q16(plane, ahead) - plane_point_q16(plane, behind);
    const float x = static_cast<float>(step_q16.x) / 65536.0F;
    const float y = static_cast<float>(step_q16.y) / 65536.0F;
    const Jacobian from = jacobian(plane, behind);
    const Jacobian to = jacobian(plane, ahead);
    Row gradient;
    for (std::size_t i = 0; i < gradient.size(); ++i) {
        gradient[i] = (x * (to[1][i] - from[1][i]) - y * (to[0][i] - from[0][i])) / (x * x + y * y);
    }
    return gradient;
}

/// Derivatives of (x, y, theta) at the reference point by the parameters. Theta is the direction of
/// the image x axis; as far as shear was taken out, that of both axes, weighted as in the fit.
std::array<Row, 3> pose_gradients(const PlaneFromImage& plane, Vec reference_q8,
                                  const FitQuality& quality) {
    constexpr std::int32_t kStep_q8 = 8 * 256;
    const Jacobian here = jacobian(plane, reference_q8);
    Row theta = direction_gradient(plane, reference_q8, {kStep_q8, 0});
    const Row across = direction_gradient(plane, reference_q8, {0, kStep_q8});
    const float share =
        static_cast<float>((256 - quality.sheared_q8) * (256 - quality.spread_u_q8)) / 65536.0F;
    for (std::size_t i = 0; i < theta.size(); ++i)
        theta[i] += share * (across[i] - theta[i]);
    return {here[0], here[1], theta};
}

}  // namespace

void estimate_covariance(const Observations& observations, const FitQuality& quality,
                         const PlaneFromImage& pattern_from_image, Vec reference_q8, Fix& fix) {
    const std::size_t size = parameters(quality.terms);
    Normal normal(size);
    std::int64_t squared_residuals = 0;
    int dots = 0;
    observations.visit([&](const Observation& o) {
        const Vec residual = plane_point_q16(pattern_from_image, o.image_point_q8) -
                             nominal_place_q16(o, quality.displacement_q16);
        if (squared(residual) >> 2 > quality.residual_limit) return;
        squared_residuals += squared(residual);
        ++dots;
        normal.add(jacobian(pattern_from_image, o.image_point_q8));
    });
    fix.dots_used = dots;
    const int freedom = std::max(2 * dots - static_cast<int>(size), 1);
    const float variance =
        static_cast<float>(squared_residuals) / 4294967296.0F / static_cast<float>(freedom);
    fix.residual_px = std::sqrt(variance) * static_cast<float>(fix.spacing_px_q16) / 65536.0F;
    if (!normal.decompose()) return;
    std::array<Row, 3> gradients = pose_gradients(pattern_from_image, reference_q8, quality);
    for (Row& row : gradients)
        row = normal.whitened(row);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            fix.covariance[i][j] = variance * normal.inner(gradients[i], gradients[j]);
        }
    }
}

}  // namespace dotpose::core

#include "core/pose/normal.hpp"

#include <algorithm>
#include <cmath>

#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

constexpr float kPower16 = 65536.0F;
constexpr float kPower24 = 16777216.0F;
constexpr float kPower30 = 1073741824.0F;
constexpr float kPower40 = kPower24 * kPower16;

std::int32_t rounded(float value) {
    return static_cast<std::int32_t>(value + (value < 0 ? -0.5F : 0.5F));
}

}  // namespace

ScaledPlane::ScaledPlane(const PlaneFromImage& plane, int reach_px)
    : plane_(plane), reach_px_(static_cast<float>(reach_px)) {
    const auto slope = [&](std::int32_t value) {
        return static_cast<float>(value) * reach_px_ / kPower24;
    };
    du_x_ = slope(plane.du_q24.x);
    du_y_ = slope(plane.du_q24.y);
    dv_x_ = slope(plane.dv_q24.x);
    dv_y_ = slope(plane.dv_q24.y);
    tilt_x_ = static_cast<float>(plane.perspective_q30.x) * reach_px_ / kPower30;
    tilt_y_ = static_cast<float>(plane.perspective_q30.y) * reach_px_ / kPower30;
    bend_ = static_cast<float>(plane.lens_q40) * reach_px_ * reach_px_ / kPower40;
}

ScaledPlane::Sight ScaledPlane::look(Vec image_point_q8) const {
    const Vec p = image_point_q8 - plane_.centre_q8;
    const float unit = 1.0F / (256.0F * reach_px_);
    const float x = static_cast<float>(p.x) * unit;
    const float y = static_cast<float>(p.y) * unit;
    const float r2 = x * x + y * y;
    const float divisor = std::max(1 + tilt_x_ * x + tilt_y_ * y + bend_ * r2, 0.25F);
    const float u = x / divisor;
    const float v = y / divisor;
    const float t = r2 / divisor;
    const float qx = du_x_ * u + dv_x_ * v;
    const float qy = du_y_ * u + dv_y_ * v;
    return {qx,
            qy,
            {Parameters{1, 0, u, -v, -qx * u, -qx * v, u, v, -qx * t},
             Parameters{0, 1, v, u, -qy * u, -qy * v, -v, u, -qy * t}}};
}

float ScaledPlane::scale() const {
    return std::sqrt((du_x_ * du_x_ + du_y_ * du_y_ + dv_x_ * dv_x_ + dv_y_ * dv_y_) / 2);
}

Parameters ScaledPlane::distortions() const {
    return {0, 0, 0, 0, tilt_x_, tilt_y_, (du_x_ - dv_y_) / 2, (dv_x_ + du_y_) / 2, bend_};
}

PlaneFromImage ScaledPlane::changed(const Parameters& by) const {
    const auto slope = [&](float value) { return rounded(value / reach_px_ * kPower24); };
    PlaneFromImage result = plane_;
    result.at_centre_q16 =
        result.at_centre_q16 + Vec{rounded(by[0] * kPower16), rounded(by[1] * kPower16)};
    result.du_q24 = result.du_q24 + Vec{slope(by[2] + by[6]), slope(by[3] + by[7])};
    result.dv_q24 = result.dv_q24 + Vec{slope(by[7] - by[3]), slope(by[2] - by[6])};
    result.perspective_q30 = {rounded((tilt_x_ + by[4]) / reach_px_ * kPower30),
                              rounded((tilt_y_ + by[5]) / reach_px_ * kPower30)};
    result.lens_q40 = rounded((bend_ + by[8]) / (reach_px_ * reach_px_) * kPower40);
    return result;
}

void Normal::add(const std::array<Parameters, 2>& jacobian, float residual_x, float residual_y,
                 float weight) {
    const auto& [a, b] = jacobian;
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        const float ai = weight * a[i];
        const float bi = weight * b[i];
        for (std::size_t j = 0; j <= i; ++j)
            m_[i][j] += ai * a[j] + bi * b[j];
        right_[i] += ai * residual_x + bi * residual_y;
    }
    squared_residuals_ += weight * (residual_x * residual_x + residual_y * residual_y);
    ++points_;
}

bool Normal::decompose() {
    // What is left of a diagonal element after the others have had their share, at least.
    constexpr float kDetermined = 1e-4F;
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        const float least = kDetermined * m_[i][i];
        for (std::size_t j = 0; j <= i; ++j) {
            float sum = m_[i][j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= m_[i][k] * m_[j][k];
            if (i != j) {
                m_[i][j] = determines(j) ? sum / m_[j][j] : 0;
            } else if (sum > least) {
                m_[i][i] = std::sqrt(sum);
            } else if (i < 4) {
                return false;
            } else {
                m_[i].fill(0);
            }
        }
    }
    return true;
}

Parameters Normal::whitened(Parameters column) const {
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            column[i] -= m_[i][k] * column[k];
        column[i] = determines(i) ? column[i] / m_[i][i] : 0;
    }
    return column;
}

Parameters Normal::unwhitened(Parameters column) const {
    for (std::size_t i = kPoseParameters; i-- > 0;) {
        for (std::size_t k = i + 1; k < kPoseParameters; ++k)
            column[i] -= m_[k][i] * column[k];
        column[i] = determines(i) ? column[i] / m_[i][i] : 0;
    }
    return column;
}

Parameters Normal::times_transposed(const Parameters& column) const {
    Parameters result{};
    for (std::size_t i = 0; i < kPoseParameters; ++i) {
        for (std::size_t k = i; k < kPoseParameters; ++k)
            result[i] += m_[k][i] * column[k];
    }
    return result;
}

}  // namespace dotpose::core

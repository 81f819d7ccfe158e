#include "core/pose/pixel_bias.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/plane_units.hpp"
#include "core/math/vectors.hpp"
#include "core/pose/dot_offsets.hpp"
#include "core/pose/dot_shape.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::bias;

/// Returns sin(2 pi x) with an error of at most 0.0011. The result is bit-identical on every
/// platform.
float sine_of_turns(float x) {
    const float turn = x - nearest_whole(x);
    const float y = 8 * turn * (1 - 2 * std::abs(turn));
    return 0.775F * y + 0.225F * y * std::abs(y);
}

/// Returns the centre of a centroid window along one axis, in px. The kernels round window centres
/// to a multiple of 1/4 px.
float place_of_window(std::int32_t window, std::int32_t sum, std::int32_t mass) {
    const float quarters =
        4 * static_cast<float>(sum) / static_cast<float>(std::max<std::int32_t>(mass, 1));
    return static_cast<float>(window) + nearest_whole(quarters) / 4;
}

/// Weights of a centroid window along one axis. The weights are w(t) = (1 - t^2)^4, and the moment
/// weights are m(t) = t w(t). `slope` is m'(t). t is the signed distance from the window centre, in
/// window radii. See kernels/loops/centroid_windows.inc.
struct WindowWeights {
    DotPixels::Line weight{};
    DotPixels::Line moment{};
    DotPixels::Line slope{};

    WindowWeights(float place_px, float radius_px) {
        // The other pixels of a line are not drawn.
        constexpr std::size_t kBegin = DotPixels::index(-DotPixels::kHalf_px);
        constexpr std::size_t kEnd = DotPixels::index(DotPixels::kHalf_px) + 1;
        for (std::size_t i = kBegin; i < kEnd; ++i) {
            const float t = (static_cast<float>(i) - DotPixels::kMiddle - place_px) / radius_px;
            const float base = std::max(1 - t * t, 0.0F);
            const float cube = base * base * base;
            weight[i] = cube * base;
            moment[i] = t * weight[i];
            slope[i] = cube * (1 - 9 * t * t);
        }
    }
};

/// Returns the weighted sum of the pixels. The weight of a pixel is the product of its weights
/// along u and v.
float weighted(const DotPixels& pixels, const DotPixels::Line& along_u,
               const DotPixels::Line& along_v) {
    Four sums{};
    for (std::size_t v = 0; v < pixels.all.size(); ++v) {
        if (along_v[v] == 0) continue;
        Four row{};
        for (std::size_t u = 0; u < DotPixels::kLine; u += 4)
            row += four_at(&pixels.all[v][u]) * four_at(&along_u[u]);
        sums += row * along_v[v];
    }
    return sums[0] + sums[1] + sums[2] + sums[3];
}

struct CentroidError {
    float px;                  ///< centroid minus true centre
    DotShape::Terms by_shape;  ///< derivatives of `px` with respect to the shape terms
    /// Slope of the moment along this axis, divided by the slope of the moment along u.
    float slope_ratio;
};

enum class Along : std::uint8_t { u, v };

/// Draws all pixels of a centroid window whose centre is at most a quarter of a pixel from the
/// centre of a pixel, with a dot at `dot_px` relative to that pixel.
DotImages window_image(const DotShape& shape, FloatVec dot_px, float radius_px) {
    const auto half_px = static_cast<int>(radius_px + 0.25F);
    return shape.drawn_at(dot_px, std::min(half_px, DotPixels::kHalf_px));
}

/// Returns the centroid error along one axis. `images` are those of a dot at `dot_px`. `dot_px` and
/// `window_px`, the window centre, are relative to a pixel centre. Like the kernels, divides the
/// moments of both axes by the slope of the moment along u.
CentroidError centroid_error(const DotImages& images, Along axis, FloatVec dot_px,
                             FloatVec window_px, float radius_px) {
    const bool is_u = axis == Along::u;
    const WindowWeights u(window_px.x, radius_px);
    const WindowWeights v(window_px.y, radius_px);
    const auto moment = [&](const DotPixels& pixels) {
        return radius_px *
               (is_u ? weighted(pixels, u.moment, v.weight) : weighted(pixels, u.weight, v.moment));
    };
    const float by = 1 / weighted(images.dot, u.slope, v.weight);
    const float offset = moment(images.dot) * by;
    const float slope = is_u ? 1 / by : weighted(images.dot, u.weight, v.slope);
    const float window_to_dot = is_u ? dot_px.x - window_px.x : dot_px.y - window_px.y;
    CentroidError error{offset - window_to_dot, {}, slope * by};
    for (std::size_t i = DotShape::radius_u; i <= DotShape::blur_uv; ++i) {
        const DotPixels& pixels = images.derivatives[i];
        error.by_shape[i] = (moment(pixels) - offset * weighted(pixels, u.slope, v.weight)) * by;
    }
    return error;
}

/// Centroid bias along one axis: amplitude * sin(2 pi phase). Valid only for windows that are
/// centred on their dots.
class AxisBias {
  public:
    AxisBias(const DotShape& shape, Along axis, float radius_px) {
        constexpr float kQuarter_px = 0.25F;  // phase at which the sine is 1
        const FloatVec quarter =
            axis == Along::u ? FloatVec{kQuarter_px, 0} : FloatVec{0, kQuarter_px};
        const CentroidError error = centroid_error(window_image(shape, quarter, radius_px), axis,
                                                   quarter, quarter, radius_px);
        const float of_model =
            tuned::kOfModel + tuned::kOfMisfit * std::max(shape.misfit() - tuned::kMisfit, 0.0F);
        amplitude_px_ = error.px;
        variance_ = shape.variance(error.by_shape) + of_model * error.px * error.px;
        const float differs = error.slope_ratio - 1;
        const float squared = differs * differs;
        slope_ratio_ = 1 + differs * squared / (squared + tuned::kSlopes * tuned::kSlopes);
    }

    float amplitude_px() const { return amplitude_px_; }
    /// Returns the slope along this axis divided by the slope along u. A slope is the derivative of
    /// the first moment of a centroid window with respect to a shift of the dot. The ratio is
    /// shrunk towards 1 if noise can explain the difference from 1.
    float slope_ratio() const { return slope_ratio_; }
    /// Returns the bias of a dot, in px. Also adds the sine of its phase to the sum for
    /// `variance_of_mean`.
    float of(float phase) {
        const float sine = sine_of_turns(phase);
        sines_ += sine;
        dots_ += 1;
        return amplitude_px_ * sine;
    }
    /// Returns the variance of the mean of all dot centres, in px^2, due to the bias that remains
    /// after the correction.
    float variance_of_mean() const {
        const float mean = sines_ / std::max(dots_, 1.0F);
        return variance_ * mean * mean;
    }

  private:
    float amplitude_px_ = 0;
    float variance_ = 0;
    float slope_ratio_ = 1;
    float sines_ = 0;
    float dots_ = 0;
};

/// Centroid errors of dots that are not at the centres of their windows.
struct WindowBias {
    float bend;         ///< cubic term of the moment: the moment is proportional to d - bend d^3
    float shear;        ///< error along each axis per px of offset along the other axis
    float slope_ratio;  ///< slope of the moment along v, divided by the slope along u

    /// Returns the centroid error, in px, of a dot at offset `d` from its window centre. The error
    /// has three causes. First, the kernels take a single Newton step, which is exact only if the
    /// moment is linear in d. Second, they divide the moments of both axes by the slope along u.
    /// Third, an oblique blur stretches the dot diagonally, so an offset along one axis also shifts
    /// the weighted centroid along the other axis.
    FloatVec at(FloatVec d) const {
        return {2 * bend * d.x * d.x * d.x + shear * d.y,
                d.y * (slope_ratio * (1 + bend * (3 * d.x * d.x - d.y * d.y)) - 1) + shear * d.x};
    }
};

WindowBias window_bias(const DotShape& shape, const AxisBias& along_u, const AxisBias& along_v,
                       float radius_px) {
    constexpr float kBeside_px = 0.1F;
    const FloatVec beside{kBeside_px, 0};
    const DotImages images = window_image(shape, beside, radius_px);
    const auto error_beside = [&](Along axis) {
        return centroid_error(images, axis, beside, {}, radius_px).px;
    };
    const float pixel_bias = along_u.amplitude_px() * sine_of_turns(kBeside_px);
    return {(error_beside(Along::u) - pixel_bias) / (2 * kBeside_px * kBeside_px * kBeside_px),
            error_beside(Along::v) / kBeside_px, along_v.slope_ratio()};
}

/// Expected image points of the inliers in a plane fit.
class ExpectedDots {
  public:
    ExpectedDots(const FloatPlane& plane, const PoseFit& fit, FloatVec centre_px,
                 const MeasuredDots& dots)
        : plane_(plane),
          by_(1 / (plane.du_x * plane.dv_y - plane.dv_x * plane.du_y)),
          displacement_(fit.displacement),
          limit_(tuning::fit::kOutlier * fit.variance),
          centre_px_(centre_px),
          dots_(dots) {}

    /// Visits every n-th dot, where n is `every`. If the dot is an inlier, calls `use` with the
    /// index of the dot and the `Phase` of its expected image point.
    template <typename Use>
    void visit(std::size_t every, Use use) const {
        for (std::size_t k = 0; k < static_cast<std::size_t>(dots_.count); k += every) {
            if (dots_.x[k] >= kNoDot_px || dots_.paper[k] <= 0) continue;
            const DotOffset dot = dot_offset(dots_, k, plane_, displacement_);
            if (!(dot.squared() <= limit_)) continue;
            const float u = (dot.residual.x * plane_.dv_y - dot.residual.y * plane_.dv_x) * by_;
            const float v = (dot.residual.y * plane_.du_x - dot.residual.x * plane_.du_y) * by_;
            use(k, Phase({dots_.x[k] + u + centre_px_.x, dots_.y[k] + v + centre_px_.y}));
        }
    }

  private:
    const FloatPlane& plane_;
    const float by_;  ///< cell area, in px^2
    const float displacement_;
    const float limit_;
    const FloatVec centre_px_;
    const MeasuredDots& dots_;
};

}  // namespace

void recentre_windows(const ImageView& image, const CentroidWindow& window, MeasuredDots& dots) {
    const auto sum_at = [](float px, std::int32_t window_px, std::int32_t mass) {
        const float from_window = px - static_cast<float>(window_px);
        return rounded(from_window * static_cast<float>(mass));
    };
    const auto right = static_cast<float>(image.width_px - 1);
    const auto bottom = static_cast<float>(image.height_px - 1);
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const float u = dots.x[k] + window.centre_px.x;
        const float v = dots.y[k] + window.centre_px.y;
        if (std::min({u, right - u, v, bottom - v}) < window.radius_px) dots.x[k] = kNoDot_px;
        dots.sum_u[k] = sum_at(u, dots.window_u[k], dots.mass[k]);
        dots.sum_v[k] = sum_at(v, dots.window_v[k], dots.mass[k]);
    }
}

FloatVec correct_pixel_bias(const ImageView& image, const CentroidWindow& window,
                            const FloatPlane& plane, const PoseFit& fit, MeasuredDots& dots) {
    const ExpectedDots expected(plane, fit, window.centre_px, dots);
    StackedDots stacks(window.dot_radius_px + tuned::kBeyondEdge_px);
    expected.visit(static_cast<std::size_t>(dots.count / tuned::kDots + 1),
                   [&](std::size_t k, const Phase& phase) {
                       stacks.add(image, phase, static_cast<float>(dots.paper[k]));
                   });
    stacks.keep_fullest(tuned::kStacks, tuned::kEnoughDots);
    DotShape shape;
    if (!shape.fit(stacks)) return {};
    // Does not correct strongly blurred dots, because their bias is negligible and they may be
    // larger than the model image.
    if (std::min(shape.blur_2().x, shape.blur_2().y) > tuned::kBlurred_px2) return {};
    AxisBias along_u(shape, Along::u, window.radius_px);
    AxisBias along_v(shape, Along::v, window.radius_px);
    const WindowBias off_centre = window_bias(shape, along_u, along_v, window.radius_px);
    constexpr float kMax_px = 0.2F;
    constexpr float kMaxBend = 4;
    if (!(std::abs(along_u.amplitude_px()) < kMax_px) ||
        !(std::abs(along_v.amplitude_px()) < kMax_px) || !(std::abs(off_centre.bend) < kMaxBend)) {
        return {};
    }
    const FloatVec offset = shape.offset();
    expected.visit(1, [&](std::size_t k, const Phase& phase) {
        const float u = place_of_window(dots.window_u[k], dots.sum_u[k], dots.mass[k]);
        const float v = place_of_window(dots.window_v[k], dots.sum_v[k], dots.mass[k]);
        const FloatVec window_error =
            off_centre.at({dots.x[k] + window.centre_px.x - u, dots.y[k] + window.centre_px.y - v});
        dots.x[k] -= along_u.of(phase.rest.x + offset.x) + window_error.x;
        dots.y[k] -= along_v.of(phase.rest.y + offset.y) + window_error.y;
    });
    return {along_u.variance_of_mean(), along_v.variance_of_mean()};
}

}  // namespace dotpose::core

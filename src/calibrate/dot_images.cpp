#include "calibrate/dot_images.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "calibrate/least_squares.hpp"
#include "calibrate/median.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector4d;

/// Radius of a dot, in spacings.
constexpr double kDotRadius = 1.0 / 12;
/// Radius of the image region in which a dot is fitted, in spacings. The nearest dots are at least
/// 2/3 of a spacing away.
constexpr double kFitRadius = 0.36;
/// Maximum distance of a dot from its expected position, in spacings.
constexpr double kMaxOffset = 0.25;
constexpr int kPasses = 4;
/// Initial value of the variance that blur and the pixel area add to the image of a dot, in px^2.
/// The next two constants are the limits for the fitted value.
constexpr double kUsualBlur_px2 = 0.5;
constexpr double kMinBlur_px2 = 0.1;
constexpr double kMaxBlur_px2 = 4;
/// Minimum contrast of a dot, relative to the median contrast of all dots.
constexpr double kMinContrast = 0.4;

/// Model of the image of a dot: level - contrast * exp(-d^T shape^-1 d / 2). d is the vector from
/// the centre, in px. shape is the covariance of the dot plus that of the blur, in px^2 (see
/// sums_of).
struct DotImage {
    double contrast = 0;
    double level = 0;
    Vector2d centre;
    /// Covariance of the centre if the image noise has a standard deviation of 1 grey level.
    Matrix2d covariance;
    bool is_valid = false;
};

/// Illumination of the paper, modelled as a quadratic polynomial in the image coordinates. The
/// polynomial is fitted to the paper levels around the dots. Without this model, the fitted centres
/// would be biased towards the darker side.
class Light {
  public:
    explicit Light(const ImageView& image)
        : middle_((image.width_px - 1) / 2.0, (image.height_px - 1) / 2.0) {}

    void fit(const std::vector<DotImage>& images) {
        NormalEquations equations(6);
        int count = 0;
        for (const DotImage& dot : images) {
            if (!dot.is_valid) continue;
            const auto [x, y] = scaled(dot.centre);
            equations.add(std::array{1.0, x, y, x * x, x * y, y * y}, dot.level);
            ++count;
        }
        constexpr int kMinDots = 30;  // with fewer dots, the polynomial is unreliable
        if (count >= kMinDots) values_ = equations.solution();
    }

    /// Returns the relative gradient of the illumination at a pixel, per px: the gradient divided
    /// by the illumination.
    Vector2d slope(const Vector2d& pixel) const {
        if (values_.empty()) return Vector2d::Zero();
        const auto& c = values_;
        const auto [x, y] = scaled(pixel);
        const double level =
            c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
        const Vector2d gradient(c[1] + 2 * c[3] * x + c[4] * y, c[2] + c[4] * x + 2 * c[5] * y);
        return gradient / (level * middle_.x());
    }

  private:
    std::array<double, 2> scaled(const Vector2d& pixel) const {
        return {(pixel.x() - middle_.x()) / middle_.x(), (pixel.y() - middle_.y()) / middle_.x()};
    }
    Vector2d middle_;
    std::vector<double> values_;
};

/// Sums in the normal equations for one dot. The parameters of the dot are contrast, level and
/// centre. All dots share one further parameter, the variance of the blur.
struct DotSums {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Vector4d right = Vector4d::Zero();
    Vector4d with_blur = Vector4d::Zero();
    double blur_normal = 0;
    double blur_right = 0;
    int pixels = 0;
};

DotSums sums_of(const ImageView& image, const ExpectedDot& expected, const DotImage& dot,
                double blur_px2, const Vector2d& light_slope) {
    const Matrix2d& to_image = expected.px_per_spacing;
    const Matrix2d to_paper = to_image.inverse();
    const Matrix2d shape = kDotRadius * kDotRadius / 4 * to_image * to_image.transpose() +
                           blur_px2 * Matrix2d::Identity();
    const Matrix2d inverse = shape.inverse();
    const Vector2d reach = kFitRadius * to_image.rowwise().norm();
    const auto first = [](double px) { return std::max(static_cast<int>(std::ceil(px)), 0); };
    const auto last = [](double px, int side) {
        return std::min(static_cast<int>(std::floor(px)), side - 1);
    };
    const int first_u = first(expected.pixel.x() - reach.x());
    const int last_u = last(expected.pixel.x() + reach.x(), image.width_px);
    const int first_v = first(expected.pixel.y() - reach.y());
    const int last_v = last(expected.pixel.y() + reach.y(), image.height_px);
    DotSums sums;
    for (int v = first_v; v <= last_v; ++v) {
        for (int u = first_u; u <= last_u; ++u) {
            const Vector2d pixel(u, v);
            if ((to_paper * (pixel - expected.pixel)).squaredNorm() > kFitRadius * kFitRadius)
                continue;
            const Vector2d scaled = inverse * (pixel - dot.centre);
            const double bell = std::exp(-scaled.dot(pixel - dot.centre) / 2);
            const double grey = image.row(v)[u] * (1 - light_slope.dot(pixel - expected.pixel));
            const double residual = grey - dot.level + dot.contrast * bell;
            const double by_centre = -dot.contrast * bell;
            const Vector4d row(-bell, 1, by_centre * scaled.x(), by_centre * scaled.y());
            const double by_blur = by_centre * scaled.squaredNorm() / 2;
            sums.normal += row * row.transpose();
            sums.right += residual * row;
            sums.with_blur += by_blur * row;
            sums.blur_normal += by_blur * by_blur;
            sums.blur_right += by_blur * residual;
            ++sums.pixels;
        }
    }
    return sums;
}

/// Returns an initial estimate of a dot, computed from the darkest and the lightest pixel near its
/// expected position.
DotImage first_image(const ImageView& image, const ExpectedDot& expected) {
    DotImage dot;
    dot.centre = expected.pixel;
    const auto [u, v] = std::array{static_cast<int>(std::lround(expected.pixel.x())),
                                   static_cast<int>(std::lround(expected.pixel.y()))};
    const int reach =
        static_cast<int>(kFitRadius * expected.px_per_spacing.rowwise().norm().minCoeff());
    int dark = 255;
    int light = 0;
    for (int y = std::max(v - reach, 0); y <= std::min(v + reach, image.height_px - 1); ++y) {
        for (int x = std::max(u - reach, 0); x <= std::min(u + reach, image.width_px - 1); ++x) {
            dark = std::min<int>(dark, image.row(y)[x]);
            light = std::max<int>(light, image.row(y)[x]);
        }
    }
    dot.level = light;
    dot.contrast = light - dark;
    dot.is_valid = light > dark;
    return dot;
}

double median_contrast(const std::vector<DotImage>& images) {
    std::vector<double> contrasts;
    for (const DotImage& image : images) {
        if (image.is_valid) contrasts.push_back(image.contrast);
    }
    if (contrasts.empty()) return 0;
    return upper_median(std::move(contrasts));
}

}  // namespace

bool is_measurable(const ImageView& image, const ExpectedDot& expected) {
    const Matrix2d& m = expected.px_per_spacing;
    const double mean = m.squaredNorm() / 2;
    const double shortest2 =
        mean - std::sqrt(std::max(mean * mean - std::pow(m.determinant(), 2), 0.0));
    if (!(shortest2 >= kMinSpacing_px * kMinSpacing_px)) return false;
    constexpr double kBlur_px = 0.5;
    const Vector2d reach = kDotRadius * m.rowwise().norm() + Vector2d::Constant(kBlur_px);
    const Vector2d last(image.width_px - 1, image.height_px - 1);
    return ((expected.pixel - reach).array() >= 0).all() &&
           ((expected.pixel + reach).array() <= last.array()).all();
}

std::vector<std::optional<DotCentre>> measured_centres(const ImageView& image,
                                                       const std::vector<ExpectedDot>& dots) {
    std::vector<DotImage> images;
    for (const ExpectedDot& dot : dots)
        images.push_back(first_image(image, dot));
    double blur_px2 = kUsualBlur_px2;
    Light light(image);
    for (int pass = 0; pass < kPasses; ++pass) {
        double normal = 0;
        double right = 0;
        for (std::size_t i = 0; i < dots.size(); ++i) {
            DotImage& dot = images[i];
            if (!dot.is_valid) continue;
            const DotSums sums = sums_of(image, dots[i], dot, blur_px2, light.slope(dots[i].pixel));
            constexpr int kMinPixels = 6;
            const auto factors = sums.normal.ldlt();
            const Vector4d step = factors.solve(sums.right);
            dot.contrast += step[0];
            dot.level += step[1];
            dot.centre += step.tail<2>();
            dot.covariance = factors.solve(Eigen::Matrix4d::Identity()).bottomRightCorner<2, 2>();
            const Vector2d offset = dots[i].px_per_spacing.inverse() * (dot.centre - dots[i].pixel);
            dot.is_valid = sums.pixels >= kMinPixels && step.allFinite() && dot.contrast > 0 &&
                           offset.norm() < kMaxOffset;
            if (!dot.is_valid) continue;
            // Eliminates the parameters of this dot from the equation for the blur variance.
            normal += sums.blur_normal - sums.with_blur.dot(factors.solve(sums.with_blur));
            right += sums.blur_right - sums.with_blur.dot(step);
        }
        light.fit(images);
        if (normal > 0)
            blur_px2 = std::clamp(blur_px2 + right / normal, kMinBlur_px2, kMaxBlur_px2);
    }
    const double min_contrast = kMinContrast * median_contrast(images);
    std::vector<std::optional<DotCentre>> centres;
    for (const DotImage& dot : images) {
        const bool is_dark = dot.is_valid && dot.contrast >= min_contrast;
        centres.push_back(is_dark ? std::optional(DotCentre{dot.centre, dot.covariance})
                                  : std::nullopt);
    }
    return centres;
}

}  // namespace dotpose::calibrate

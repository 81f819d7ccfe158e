#include "core/pose/dot_model.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace dotpose::core {
namespace {

constexpr auto kSide = DotPixels::kSide;

/// Chords of half an ellipse at equal steps of the parametric angle a, from the outermost to the
/// innermost. Each element is cos(a): the chord is at v = radius.y cos(a), and its ends are at u =
/// +-radius.x sin(a). The other half of the ellipse is symmetric. Adjacent chords must be less than
/// a pixel apart, so a small ellipse needs fewer chords (kChordsOfSmall).
constexpr float kChordsOfSmall[] = {0.99144486F, 0.92387953F, 0.79335334F,
                                    0.60876143F, 0.38268343F, 0.13052619F};
constexpr float kChords[] = {0.99691733F, 0.97236992F, 0.92387953F, 0.85264016F, 0.76040597F,
                             0.64944805F, 0.52249856F, 0.38268343F, 0.23344536F, 0.07845910F};
// An ellipse is small if both squared semi-axes are below this value.
constexpr float kSmall_px2 = 4;

/// Returns exp(-x) for x >= 0. Unlike std::exp, the result is bit-identical on every platform.
float exp_of_minus(float x) {
    constexpr float kLog2 = 0.693147181F;
    if (!(x < 80)) return 0;
    const float halvings = std::floor(x / kLog2 + 0.5F);
    const float y = halvings * kLog2 - x;
    const float power =
        1 + y * (1 + y * (1.0F / 2 +
                          y * (1.0F / 6 + y * (1.0F / 24 + y * (1.0F / 120 + y * (1.0F / 720))))));
    return std::ldexp(power, -static_cast<int>(halvings));
}

/// Normal distribution with mean 0, evaluated at x.
struct Normal {
    float density;
    float cumulative;
    float integral;  ///< integral of `cumulative` from -infinity to x

    Normal(float x, float sigma) {
        // Abramowitz and Stegun, Handbook of Mathematical Functions, 26.2.17. The error is below
        // 1e-7.
        const float z = x / sigma;
        const float density_of_z = 0.39894228F * exp_of_minus(z * z / 2);
        const float t = 1 / (1 + 0.2316419F * std::abs(z));
        const float tail =
            density_of_z * t *
            (0.31938153F +
             t * (-0.356563782F + t * (1.781477937F + t * (-1.821255978F + t * 1.330274429F))));
        density = density_of_z / sigma;
        cumulative = z > 0 ? 1 - tail : tail;
        integral = x * cumulative + sigma * density_of_z;
    }
};

/// Responses of a line of pixels to a blurred step and to a blurred point. `place` is the
/// coordinate of the step or point.
struct PixelLine {
    /// Response to a step of the darkness from 0 to 1 at `place`.
    std::array<float, kSide> step;
    /// Response to a point: the negative derivative of `step` with respect to `place`.
    std::array<float, kSide> point;
    std::array<float, kSide> slope;  ///< negative derivative of `point` with respect to `place`
    /// Derivative of `point` with respect to the blur variance.
    std::array<float, kSide> point_by_blur;

    PixelLine(float place, float blur_2, int half_px) {
        const float sigma = std::sqrt(blur_2);
        Normal before(-0.5F - static_cast<float>(half_px) - place, sigma);
        for (int from_middle = -half_px; from_middle <= half_px; ++from_middle) {
            const auto i = static_cast<std::size_t>(from_middle + DotPixels::kHalf_px);
            const float x = static_cast<float>(from_middle) - 0.5F - place;
            const Normal after(x + 1, sigma);
            step[i] = after.integral - before.integral;
            point[i] = after.cumulative - before.cumulative;
            slope[i] = after.density - before.density;
            point_by_blur[i] = (x * before.density - (x + 1) * after.density) / (2 * blur_2);
            before = after;
        }
    }
    /// Returns the derivative of `step` with respect to the blur variance.
    float step_by_blur(std::size_t i) const { return slope[i] / 2; }
};

}  // namespace

DotImages draw(const ModelDot& dot, int half_px) {
    DotImages images;
    auto& [by_u, by_v, by_radius_u, by_radius_v, by_blur_u, by_blur_v, by_blur_uv] =
        images.derivatives;
    const FloatVec radius{std::sqrt(dot.radius_2.x), std::sqrt(dot.radius_2.y)};
    const bool is_small = std::max(dot.radius_2.x, dot.radius_2.y) < kSmall_px2;
    const std::span<const float> cosines =
        is_small ? std::span<const float>(kChordsOfSmall) : kChords;
    const auto begin = static_cast<std::size_t>(DotPixels::kHalf_px - half_px);
    const std::size_t end = kSide - begin;
    for (std::size_t chord = 0; chord < cosines.size(); ++chord) {
        const float cosine = cosines[chord];
        const float sine = cosines[cosines.size() - 1 - chord];
        const PixelLine left(dot.centre.x - radius.x * sine, dot.blur_2.x, half_px);
        const PixelLine right(dot.centre.x + radius.x * sine, dot.blur_2.x, half_px);
        const PixelLine above(dot.centre.y - radius.y * cosine, dot.blur_2.y, half_px);
        const PixelLine below(dot.centre.y + radius.y * cosine, dot.blur_2.y, half_px);
        // Fraction of the ellipse area that the chord represents, divided by the chord length in
        // px.
        const float fraction = sine / (2 * static_cast<float>(cosines.size()) * radius.x);
        for (std::size_t v = begin; v < end; ++v) {
            const float down = fraction * (below.point[v] + above.point[v]);
            const float down_by_v = -fraction * (below.slope[v] + above.slope[v]);
            const float down_by_radius = -fraction * cosine * (below.slope[v] - above.slope[v]);
            const float down_by_blur = fraction * (below.point_by_blur[v] + above.point_by_blur[v]);
            for (std::size_t u = begin; u < end; ++u) {
                const float across = left.step[u] - right.step[u];
                const float across_by_u = right.point[u] - left.point[u];
                images.dot.all[v][u] += down * across;
                by_u.all[v][u] += down * across_by_u;
                by_v.all[v][u] += down_by_v * across;
                by_radius_u.all[v][u] += down * sine * (left.point[u] + right.point[u]);
                by_radius_v.all[v][u] += down_by_radius * across;
                by_blur_u.all[v][u] += down * (left.step_by_blur(u) - right.step_by_blur(u));
                by_blur_v.all[v][u] += down_by_blur * across;
                // By the heat equation, the derivative with respect to the covariance of the blur
                // is the mixed second derivative with respect to u and v.
                by_blur_uv.all[v][u] += down_by_v * across_by_u;
            }
        }
    }
    for (std::size_t v = begin; v < end; ++v) {
        for (std::size_t u = begin; u < end; ++u) {
            // `fraction` is proportional to 1 / radius.x, so the derivative with respect to
            // radius.x includes -dot / radius.x. Division by 2 * radius converts a derivative with
            // respect to a semi-axis to a derivative with respect to its square.
            float& by = by_radius_u.all[v][u];
            by = (by - images.dot.all[v][u] / radius.x) / (2 * radius.x);
            by_radius_v.all[v][u] /= 2 * radius.y;
            images.dot.all[v][u] += dot.blur_uv * by_blur_uv.all[v][u];
        }
    }
    return images;
}

}  // namespace dotpose::core

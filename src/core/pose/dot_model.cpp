#include "core/pose/dot_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "core/math/vectors.hpp"

namespace dotpose::core {
namespace {

/// Chords of half an ellipse at equal steps of the parametric angle a, from the outermost to the
/// innermost. Each element is cos(a): the chord is at v = radius.y cos(a), and its ends are at u =
/// +-radius.x sin(a). The other half of the ellipse is symmetric.
constexpr float kThreeChords[] = {0.96592583F, 0.70710678F, 0.25881905F};
constexpr float kFourChords[] = {0.98078528F, 0.83146961F, 0.55557023F, 0.19509032F};
constexpr float kSixChords[] = {0.99144486F, 0.92387953F, 0.79335334F,
                                0.60876143F, 0.38268343F, 0.13052619F};
constexpr float kTenChords[] = {0.99691733F, 0.97236992F, 0.92387953F, 0.85264016F, 0.76040597F,
                                0.64944805F, 0.52249856F, 0.38268343F, 0.23344536F, 0.07845910F};

/// Returns enough chords for the dot. Larger and sharper dots need more chords. If the blur is at
/// least 0.2 px, the error in each pixel is at most 0.0006 of the darkness of the dot.
std::span<const float> chords_of(const ModelDot& dot) {
    constexpr float kMinBlur_px2 = 0.04F;
    const float radius_px2 = std::max(dot.radius_2.x, dot.radius_2.y);
    const float blur_px2 = std::min(dot.blur_2.x, dot.blur_2.y);
    if (radius_px2 < 0.4F && blur_px2 > kMinBlur_px2) return kThreeChords;
    if (radius_px2 < 1 && blur_px2 > kMinBlur_px2) return kFourChords;
    return radius_px2 < 4 ? std::span<const float>(kSixChords) : kTenChords;
}

/// Returns exp(-x) for x >= 0. Unlike std::exp, the result is bit-identical on every platform.
Four exp_of_minus(Four x) {
    constexpr float kLog2 = 0.693147181F;
    constexpr float kMax = 80;
    const FourInts is_normal = x < kMax;
    x = is_normal ? x : Four{} + kMax;
    const FourInts halvings = __builtin_convertvector(x * (1 / kLog2) + 0.5F, FourInts);
    const Four y = __builtin_convertvector(halvings, Four) * kLog2 - x;
    const Four power =
        1 + y * (1 + y * (1.0F / 2 +
                          y * (1.0F / 6 + y * (1.0F / 24 + y * (1.0F / 120 + y * (1.0F / 720))))));
    const auto power_of_two = __builtin_bit_cast(Four, (127 - halvings) << 23);
    return is_normal ? power * power_of_two : Four{};
}

/// Normal distribution with mean 0, evaluated at four points x.
struct Normal {
    Four density;
    Four cumulative;
    Four integral;  ///< integral of `cumulative` from -infinity to x

    Normal(Four x, float sigma) {
        // Abramowitz and Stegun, Handbook of Mathematical Functions, 26.2.17. The error is below
        // 1e-7.
        const float per_sigma = 1 / sigma;
        const Four z = x * per_sigma;
        const Four size = z < 0 ? -z : z;
        const Four density_of_z = 0.39894228F * exp_of_minus(z * z * 0.5F);
        const Four t = 1 / (1 + 0.2316419F * size);
        const Four tail =
            density_of_z * t *
            (0.31938153F +
             t * (-0.356563782F + t * (1.781477937F + t * (-1.821255978F + t * 1.330274429F))));
        density = density_of_z * per_sigma;
        cumulative = z > 0 ? 1 - tail : tail;
        integral = x * cumulative + sigma * density_of_z;
    }
};

/// Groups of four pixels of a line. They contain all pixels within `half_px` of the central pixel,
/// and one more.
struct Groups {
    std::size_t begin;  ///< first pixel of the first group
    std::size_t end;    ///< first pixel after the last group

    explicit Groups(int half_px)
        : begin(DotPixels::index(-half_px) / 4 * 4), end((DotPixels::index(half_px) + 5) / 4 * 4) {}
};

void store(Four values, float* at) {
    std::memcpy(at, &values, sizeof values);
}

/// Responses of a line of pixels to a blurred step and to a blurred point. `place` is the
/// coordinate of the step or point.
struct PixelLine {
    /// Response to a step of the darkness from 0 to 1 at `place`.
    DotPixels::Line step;
    /// Response to a point: the negative derivative of `step` with respect to `place`.
    DotPixels::Line point;
    DotPixels::Line slope;  ///< negative derivative of `point` with respect to `place`
    /// Derivative of `point` with respect to the blur variance.
    DotPixels::Line point_by_blur;

    PixelLine(float place, float blur_2, const Groups& groups) {
        constexpr Four kFirst{0, 1, 2, 3};
        const float sigma = std::sqrt(blur_2);
        const float by_blur = 0.5F / blur_2;
        // Normal distributions at the lower edges of the pixels. The last element is not computed.
        std::array<float, DotPixels::kLine + 1> density;
        std::array<float, DotPixels::kLine + 1> cumulative;
        std::array<float, DotPixels::kLine + 1> integral;
        const auto edge = [&](std::size_t i) {
            return kFirst + (static_cast<float>(i) - DotPixels::kMiddle - 0.5F) - place;
        };
        density[groups.end] = cumulative[groups.end] = integral[groups.end] = 0;
        for (std::size_t i = groups.begin; i < groups.end; i += 4) {
            const Normal normal(edge(i), sigma);
            store(normal.density, &density[i]);
            store(normal.cumulative, &cumulative[i]);
            store(normal.integral, &integral[i]);
        }
        for (std::size_t i = groups.begin; i < groups.end; i += 4) {
            const Four before = four_at(&density[i]);
            const Four after = four_at(&density[i + 1]);
            const Four x = edge(i);
            store(four_at(&integral[i + 1]) - four_at(&integral[i]), &step[i]);
            store(four_at(&cumulative[i + 1]) - four_at(&cumulative[i]), &point[i]);
            store(after - before, &slope[i]);
            store((x * before - (x + 1) * after) * by_blur, &point_by_blur[i]);
        }
    }
    /// Returns the derivative of `step` with respect to the blur variance, for a group of pixels.
    Four step_by_blur(std::size_t i) const { return four_at(&slope[i]) * 0.5F; }
};

/// Adds `values` to a group of pixels.
void add(Four values, float* to) {
    store(four_at(to) + values, to);
}

/// Adds the part of the ellipse that a chord and its mirror image represent. `cosine` and `sine`
/// are those of the parametric angle, and `fraction` is the part of the ellipse area divided by the
/// chord length in px.
void add_chord(const ModelDot& dot, FloatVec radius, float cosine, float sine, float fraction,
               int half_px, DotImages& images) {
    auto& [by_u, by_v, by_radius_u, by_radius_v, by_blur_u, by_blur_v, by_blur_uv] =
        images.derivatives;
    const Groups groups(half_px);
    const PixelLine left(dot.centre.x - radius.x * sine, dot.blur_2.x, groups);
    const PixelLine right(dot.centre.x + radius.x * sine, dot.blur_2.x, groups);
    const PixelLine above(dot.centre.y - radius.y * cosine, dot.blur_2.y, groups);
    const PixelLine below(dot.centre.y + radius.y * cosine, dot.blur_2.y, groups);
    for (std::size_t v = DotPixels::index(-half_px); v <= DotPixels::index(half_px); ++v) {
        const float down = fraction * (below.point[v] + above.point[v]);
        const float down_by_v = -fraction * (below.slope[v] + above.slope[v]);
        const float down_by_radius = -fraction * cosine * (below.slope[v] - above.slope[v]);
        const float down_by_blur = fraction * (below.point_by_blur[v] + above.point_by_blur[v]);
        for (std::size_t u = groups.begin; u < groups.end; u += 4) {
            const Four left_point = four_at(&left.point[u]);
            const Four right_point = four_at(&right.point[u]);
            const Four across = four_at(&left.step[u]) - four_at(&right.step[u]);
            const Four across_by_u = right_point - left_point;
            const Four across_by_blur = left.step_by_blur(u) - right.step_by_blur(u);
            add(down * across, &images.dot.all[v][u]);
            add(down * across_by_u, &by_u.all[v][u]);
            add(down_by_v * across, &by_v.all[v][u]);
            add(down * sine * (left_point + right_point), &by_radius_u.all[v][u]);
            add(down_by_radius * across, &by_radius_v.all[v][u]);
            add(down * across_by_blur, &by_blur_u.all[v][u]);
            add(down_by_blur * across, &by_blur_v.all[v][u]);
            // By the heat equation, the derivative with respect to the covariance of the blur is
            // the mixed second derivative with respect to u and v.
            add(down_by_v * across_by_u, &by_blur_uv.all[v][u]);
        }
    }
}

}  // namespace

DotImages draw(const ModelDot& dot, int half_px) {
    DotImages images;
    const FloatVec radius{std::sqrt(dot.radius_2.x), std::sqrt(dot.radius_2.y)};
    const std::span<const float> cosines = chords_of(dot);
    for (std::size_t chord = 0; chord < cosines.size(); ++chord) {
        const float sine = cosines[cosines.size() - 1 - chord];
        const float fraction = sine / (2 * static_cast<float>(cosines.size()) * radius.x);
        add_chord(dot, radius, cosines[chord], sine, fraction, half_px, images);
    }
    const Groups groups(half_px);
    auto& by_radius_u = images.derivatives[2];
    auto& by_radius_v = images.derivatives[3];
    const auto& by_blur_uv = images.derivatives[6];
    for (std::size_t v = DotPixels::index(-half_px); v <= DotPixels::index(half_px); ++v) {
        for (std::size_t u = groups.begin; u < groups.end; u += 4) {
            const Four drawn = four_at(&images.dot.all[v][u]);
            // `fraction` is proportional to 1 / radius.x, so the derivative with respect to
            // radius.x includes -dot / radius.x. Division by 2 * radius converts a derivative with
            // respect to a semi-axis to a derivative with respect to its square.
            store((four_at(&by_radius_u.all[v][u]) - drawn / radius.x) / (2 * radius.x),
                  &by_radius_u.all[v][u]);
            store(four_at(&by_radius_v.all[v][u]) / (2 * radius.y), &by_radius_v.all[v][u]);
            add(dot.blur_uv * four_at(&by_blur_uv.all[v][u]), &images.dot.all[v][u]);
        }
    }
    return images;
}

}  // namespace dotpose::core

#include "core/pose/dot_shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/vectors.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::shape;

constexpr float kPi = 3.14159265F;

/// The linearized model of the used pixels of a stack: a row for each term with the derivatives of
/// the pixels, and a row with their residuals.
class PixelRows {
  public:
    static constexpr std::size_t kResidual = DotShape::Term::count;

    /// `images` are those of a model dot in the middle of the stack.
    PixelRows(const StackedDots& stacks, const StackedDots::Stack& stack, const DotImages& images,
              const DotShape::Terms& terms) {
        const float mass = terms[DotShape::mass];
        stacks.visit_pixels([&](int u, int v) {
            const float dot = images.dot.at(u, v);
            for (std::size_t i = 0; i < images.derivatives.size(); ++i)
                rows_[i][count_] = mass * images.derivatives[i].at(u, v);
            rows_[DotShape::mass][count_] = dot;
            rows_[DotShape::paper][count_] = 1;
            rows_[kResidual][count_] =
                stack.darkness.at(u, v) / stack.dots - (mass * dot + terms[DotShape::paper]);
            ++count_;
        });
        for (auto& row : rows_)
            std::fill_n(&row[count_], 3, 0.0F);
    }
    float count() const { return static_cast<float>(count_); }
    /// Returns the sum of the products of the elements of two rows.
    float inner(std::size_t a, std::size_t b) const {
        Four sums{};
        for (std::size_t i = 0; i < count_; i += 4)
            sums += four_at(&rows_[a][i]) * four_at(&rows_[b][i]);
        return (sums[0] + sums[1]) + (sums[2] + sums[3]);
    }

  private:
    static constexpr std::size_t kMax =
        (2 * DotPixels::kHalf_px + 1) * (2 * DotPixels::kHalf_px + 1);

    std::array<std::array<float, kMax + 3>, DotShape::Term::count + 1> rows_;
    std::size_t count_ = 0;
};

}  // namespace

void DotShape::Normal::add(const Terms& derivatives, float rest, float weight) {
    cost += weight * rest * rest;
    NormalEquations::add(derivatives, rest, weight);
}

bool DotShape::Normal::decompose() {
    constexpr float kDetermined = 1e-5F;
    return NormalEquations::decompose(kDetermined, Term::count);
}

void DotShape::Normal::expect(Term term, float value, float sigma, const Terms& now) {
    Terms derivatives{};
    derivatives[term] = 1;
    add(derivatives, value - now[term], 1 / (sigma * sigma));
}

DotShape::Normal DotShape::equations(const StackedDots& stacks, const Terms& terms,
                                     const Terms& first, float noise_2) {
    Normal normal;
    stacks.visit([&](const StackedDots::Stack& stack) {
        const DotImages images = draw(dot(terms, {stack.rest.x / stack.dots + terms[offset_u],
                                                  stack.rest.y / stack.dots + terms[offset_v]}),
                                      stacks.half_px());
        const PixelRows rows(stacks, stack, images, terms);
        const float weight = stack.dots / noise_2;
        for (std::size_t i = 0; i < Term::count; ++i) {
            for (std::size_t j = 0; j <= i; ++j)
                normal.add_to(i, j, weight * rows.inner(i, j));
            normal.add_to_right(i, weight * rows.inner(i, PixelRows::kResidual));
        }
        normal.cost += weight * rows.inner(PixelRows::kResidual, PixelRows::kResidual);
        normal.pixels += rows.count();
    });
    normal.squares = normal.cost;
    normal.expect(offset_u, 0, tuned::kOff_px, terms);
    normal.expect(offset_v, 0, tuned::kOff_px, terms);
    normal.expect(radius_u, first[radius_u], first[radius_u], terms);
    normal.expect(blur_u, tuned::kBlur_2, tuned::kBlur_2, terms);
    normal.expect(blur_v, tuned::kBlur_2, tuned::kBlur_2, terms);
    normal.expect(blur_uv, 0, tuned::kBlur_2, terms);
    // Prior: the two semi-axes are about equal.
    Terms by_width{};
    by_width[radius_u] = 1 / first[radius_u];
    by_width[radius_v] = -by_width[radius_u];
    normal.add(by_width, (terms[radius_v] - terms[radius_u]) / first[radius_u],
               1 / (tuned::kSigmaOfWidth * tuned::kSigmaOfWidth));
    // Prior: the ink contrast is about kContrast. This prior is necessary, because the image of a
    // small dot determines only the product of area and contrast.
    const float area = kPi * std::sqrt(terms[radius_u] * terms[radius_v]);
    const float contrast = terms[mass] / area;
    Terms by_contrast{};
    by_contrast[radius_u] = -contrast / (2 * terms[radius_u]);
    by_contrast[radius_v] = -contrast / (2 * terms[radius_v]);
    by_contrast[mass] = 1 / area;
    normal.add(by_contrast, tuned::kContrast - contrast,
               1 / (tuned::kSigmaOfContrast * tuned::kSigmaOfContrast));
    return normal;
}

DotShape::Terms DotShape::changed(const Terms& terms, const Terms& step) {
    Terms result = terms;
    for (std::size_t i = 0; i < Term::count; ++i)
        result[i] += step[i];
    // Semi-axes and blur must remain positive, so a step cannot reduce any of these terms to less
    // than a quarter of its value, or below kMin_px2.
    for (const std::size_t i : {radius_u, radius_v, blur_u, blur_v})
        result[i] = std::max({result[i], terms[i] / 4, tuned::kMin_px2});
    return result;
}

bool DotShape::fit(const StackedDots& stacks) {
    if (!stacks.are_enough()) return false;
    const float noise_2 = stacks.noise_2();
    const float darkness = stacks.mass();
    const float radius_2 = std::max(darkness / (kPi * tuned::kContrast), tuned::kMin_px2);
    const Terms first{0, 0, radius_2, radius_2, tuned::kBlur_2, tuned::kBlur_2, 0, darkness, 0};
    terms_ = first;
    // The variance of an ellipse along one axis is a quarter of its squared semi-axis, and that of
    // a square pixel is 1/12 px^2. The rest of the spread is due to the blur.
    const float blur_2 = stacks.spread_px2() - radius_2 / 4 - 1.0F / 12;
    terms_[blur_u] = terms_[blur_v] =
        std::clamp(blur_2, tuned::kMinFirstBlur_2, tuned::kMaxFirstBlur_2);
    Normal normal = equations(stacks, terms_, first, noise_2);
    float damping = tuned::kFirstDamping;
    // Damped least squares (Levenberg 1944, Marquardt 1963).
    for (int round = 0; round < tuned::kMaxRounds && damping < tuned::kMaxDamping; ++round) {
        Normal damped = normal;
        damped.scale_diagonal(1 + damping);
        damping *= tuned::kDampingGrows;
        if (!damped.decompose()) continue;
        const Terms next = changed(terms_, damped.solution());
        const Normal there = equations(stacks, next, first, noise_2);
        const float gain = normal.cost - there.cost;
        if (!(gain > 0)) continue;
        terms_ = next;
        normal = there;
        damping /= tuned::kDampingGrows * tuned::kDampingGrows;
        if (gain < tuned::kSettled) break;
    }
    normal_ = normal;
    misfit_ = std::max(
        normal.squares / std::max(normal.pixels - static_cast<float>(Term::count), 1.0F), 1.0F);
    return normal_.decompose();
}

float DotShape::variance(const Terms& derivatives) const {
    float sum = 0;
    for (const float part : normal_.whitened(derivatives))
        sum += part * part;
    return misfit_ * sum;
}

}  // namespace dotpose::core

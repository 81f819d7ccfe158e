#include "core/pose/dot_shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::shape;

constexpr float kPi = 3.14159265F;

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
        stacks.visit_pixels([&](int u, int v) {
            Terms derivatives;
            for (std::size_t i = 0; i < images.derivatives.size(); ++i)
                derivatives[i] = terms[mass] * images.derivatives[i].at(u, v);
            derivatives[mass] = images.dot.at(u, v);
            derivatives[paper] = 1;
            const float model = terms[mass] * images.dot.at(u, v) + terms[paper];
            normal.add(derivatives, stack.darkness.at(u, v) / stack.dots - model,
                       stack.dots / noise_2);
            normal.pixels += 1;
        });
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

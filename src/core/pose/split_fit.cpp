#include "core/pose/split_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/pose/dot_offsets.hpp"
#include "core/pose/float_fit.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::paper_step;

/// Finds a residual that many dots near a point have in common. Sets `common` to the residual, in
/// spacings, that agrees with the largest number of residuals, including itself. Two residuals
/// agree if their squared difference is less than kAgreement. Returns false if fewer than
/// kMinAgreeing residuals agree with `common`.
bool find_common_offset(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                        FloatVec near, FloatVec& common) {
    constexpr std::size_t kMaxDots = 256;
    constexpr float kReach = tuned::kReach;
    std::array<FloatVec, kMaxDots> offsets;
    std::size_t count = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count) && count < kMaxDots; ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const DotOffset dot = dot_offset(dots, k, plane, displacement);
        const bool is_near =
            std::abs(dot.at.x - near.x) < kReach && std::abs(dot.at.y - near.y) < kReach;
        if (is_near && dot.squared() < 1) offsets[count++] = dot.residual;
    }
    int max_agreeing = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto agreeing = std::count_if(
            offsets.begin(), offsets.begin() + static_cast<std::ptrdiff_t>(count), [&](FloatVec o) {
                const FloatVec d{o.x - offsets[i].x, o.y - offsets[i].y};
                return d.x * d.x + d.y * d.y < tuned::kAgreement;
            });
        if (agreeing <= max_agreeing) continue;
        max_agreeing = static_cast<int>(agreeing);
        common = offsets[i];
    }
    return max_agreeing >= tuned::kMinAgreeing;
}

}  // namespace

HalfPlane::HalfPlane(Side side, MeasuredDots& dots, const FloatPlane& plane, FloatVec reference_px,
                     const PaperStep& step)
    : dots_(dots) {
    const float sign = side == Side::here ? 1 : -1;
    const FloatVec reference = plane_point(plane, reference_px);
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const FloatVec at = plane_point(plane, {dots.x[k], dots.y[k]});
        const float beyond = (at.x - reference.x) * step.direction.x +
                             (at.y - reference.y) * step.direction.y - step.distance;
        if (sign * beyond > -tuned::kMargin) dots.column[k] += kFar;
    }
}

HalfPlane::~HalfPlane() {
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots_.count); ++k) {
        if (dots_.column[k] > kFar / 2) dots_.column[k] -= kFar;
    }
}

bool fit_this_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   SplitFit& split) {
    const float displacement = split.fit.displacement;
    split.step = find_paper_step(dots, split.plane, split.fit, reference_px);
    const float gain = split.step.gain;
    if (gain < PaperStep::kPossible) return false;
    const int rounds = dots.count < tuned::kFewDots ? 1 : tuned::kRounds;
    for (int round = 0; round < rounds; ++round) {
        const HalfPlane only(HalfPlane::Side::here, dots, split.plane, reference_px, split.step);
        if (!fit_plane(kernels, dots, split.fit.reach_px, tuned::kFarOff, displacement, split.plane,
                       split.fit))
            return false;
        if (round + 1 == rounds) break;
        // Searches for the line again. The residuals are now relative to the plane of one side, so
        // the search is more precise than with the plane of all dots. The gain of this search is
        // ignored: it is not a valid likelihood ratio, because the plane was not fitted to the dots
        // beyond the line.
        const PaperStep step = find_paper_step(dots, split.plane, split.fit, reference_px);
        if (step.gain > 0) split.step = step;
    }
    split.step.gain = gain;
    return true;
}

bool fit_far_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                  const SplitFit& split, FloatPlane& beyond) {
    beyond = split.plane;
    const HalfPlane only(HalfPlane::Side::beyond, dots, beyond, reference_px, split.step);
    FloatVec common;
    if (!find_common_offset(dots, beyond, split.fit.displacement, plane_point(beyond, reference_px),
                            common))
        return false;
    beyond.at_x += common.x;
    beyond.at_y += common.y;
    PoseFit fit = split.fit;
    return fit_plane(kernels, dots, fit.reach_px, tuned::kFarOff, fit.displacement, beyond, fit);
}

}  // namespace dotpose::core

#include "core/pose/sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/pose/dot_offsets.hpp"
#include "core/pose/float_fit.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::slip;

/// Finds the residual, in spacings, that most of the dots near a point share. Returns false if too
/// few share one.
bool find_common_offset(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                        FloatVec near, FloatVec& common) {
    constexpr std::size_t kMost = 256;
    constexpr float kReach = tuned::kReach;
    std::array<FloatVec, kMost> offsets;
    std::size_t count = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count) && count < kMost; ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const DotOffset dot = dot_offset(dots, k, plane, displacement);
        const bool is_near =
            std::abs(dot.at.x - near.x) < kReach && std::abs(dot.at.y - near.y) < kReach;
        if (is_near && dot.squared() < 1) offsets[count++] = dot.off;
    }
    int most = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto alike = std::count_if(
            offsets.begin(), offsets.begin() + static_cast<std::ptrdiff_t>(count), [&](FloatVec o) {
                const FloatVec d{o.x - offsets[i].x, o.y - offsets[i].y};
                return d.x * d.x + d.y * d.y < tuned::kAlike;
            });
        if (alike <= most) continue;
        most = static_cast<int>(alike);
        common = offsets[i];
    }
    return most >= tuned::kFewestAlike;
}

}  // namespace

OneSide::OneSide(Side side, MeasuredDots& dots, const FloatPlane& plane, FloatVec reference_px,
                 const Slip& slip)
    : dots_(dots) {
    const float sign = side == Side::here ? 1 : -1;
    const FloatVec reference = plane_point(plane, reference_px);
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const FloatVec at = plane_point(plane, {dots.x[k], dots.y[k]});
        const float beyond = (at.x - reference.x) * slip.direction.x +
                             (at.y - reference.y) * slip.direction.y - slip.distance;
        if (sign * beyond > -tuned::kMargin) dots.column[k] += kFar;
    }
}

OneSide::~OneSide() {
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots_.count); ++k) {
        if (dots_.column[k] > kFar / 2) dots_.column[k] -= kFar;
    }
}

bool fit_this_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   Sides& sides) {
    const float displacement = sides.fit.displacement;
    sides.slip = find_slip(dots, sides.plane, sides.fit, reference_px);
    const float gain = sides.slip.gain;
    if (gain < Slip::kPossible) return false;
    for (int round = 0; round < tuned::kRounds; ++round) {
        const OneSide only(OneSide::Side::here, dots, sides.plane, reference_px, sides.slip);
        if (!fit_plane(kernels, dots, sides.fit.reach_px, tuned::kFarOff, displacement, sides.plane,
                       sides.fit))
            return false;
        if (round + 1 == tuned::kRounds) break;
        // The line is seen more clearly from the plane of one side. Whether there is one is not:
        // the dots beyond had no say in this plane.
        const Slip slip = find_slip(dots, sides.plane, sides.fit, reference_px);
        if (slip.gain > 0) sides.slip = slip;
    }
    sides.slip.gain = gain;
    return true;
}

bool fit_far_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                  const Sides& sides, FloatPlane& beyond) {
    beyond = sides.plane;
    const OneSide only(OneSide::Side::beyond, dots, beyond, reference_px, sides.slip);
    FloatVec common;
    if (!find_common_offset(dots, beyond, sides.fit.displacement, plane_point(beyond, reference_px),
                            common))
        return false;
    beyond.at_x += common.x;
    beyond.at_y += common.y;
    PoseFit fit = sides.fit;
    return fit_plane(kernels, dots, fit.reach_px, tuned::kFarOff, fit.displacement, beyond, fit);
}

}  // namespace dotpose::core

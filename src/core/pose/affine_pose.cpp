#include "core/pose/affine_pose.hpp"

#include <array>

#include "core/cell_fit.hpp"
#include "core/cells.hpp"

namespace dotpose::core {
namespace {

/// So many dots, evenly spread, tell the displacement and the scatter.
constexpr int kSample = 64;

/// Median over a sample of the dots.
template <typename Value>
std::int32_t sampled_median(const Observations& observations, Value value) {
    const int every = observations.count() / kSample + 1;
    std::array<std::int32_t, kSample> values;
    std::size_t count = 0;
    int seen = 0;
    observations.visit([&](const Observation& o) {
        if (++seen < every) return;
        seen = 0;
        values[count++] = value(o);
    });
    return median(std::span(values).first(count));
}

}  // namespace

int fit_affine_pose(const Observations& observations, PlaneFromImage& pose) {
    const Cells cells(pose);
    const auto offset_q16 = [&](const Observation& o, Vec p) {
        return cells.plane_point_q16(p) - Vec{o.pattern_step.x * 65536, o.pattern_step.y * 65536};
    };
    // As printed and seen: ink spreads and lenses blur differently each time.
    const std::int32_t displacement_q16 = sampled_median(observations, [&](const Observation& o) {
        const Vec offset = offset_q16(o, cells.from_centre_q3(o.image_point_q8));
        return offset.x * dx(o.symbol) + offset.y * dy(o.symbol);
    });
    const auto squared_residual_q16 = [&](const Observation& o, Vec p) {
        const Vec r = offset_q16(o, p) -
                      Vec{dx(o.symbol) * displacement_q16, dy(o.symbol) * displacement_q16};
        return (r.x >> 8) * (r.x >> 8) + (r.y >> 8) * (r.y >> 8);
    };
    // Squared distances of a plane Gaussian have their median at 1.39 sigma^2; 12 medians lie
    // 4 sigma out, where 1 dot in 3,000 is lost by chance.
    const std::int32_t limit_q16 =
        12 * sampled_median(observations,
                            [&](const Observation& o) {
                                return squared_residual_q16(o,
                                                            cells.from_centre_q3(o.image_point_q8));
                            }) +
        1;

    // Where dots were printed, in 1/64 cells: at most 2^15 of them.
    constexpr int kTargetBits = 6;
    const std::int32_t displacement = shift_rounded(displacement_q16, 16 - kTargetBits);
    CellFit fit;
    observations.visit([&](const Observation& o) {
        const Vec p = cells.from_centre_q3(o.image_point_q8);
        if (squared_residual_q16(o, p) > limit_q16) return;
        fit.add(p, {o.pattern_step.x * (1 << kTargetBits) + dx(o.symbol) * displacement,
                    o.pattern_step.y * (1 << kTargetBits) + dy(o.symbol) * displacement});
    });
    return fit.solve(kTargetBits, pose) ? fit.count() : 0;
}

}  // namespace dotpose::core

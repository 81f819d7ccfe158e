#include "device/affine_pose.hpp"

#include <array>

#include "core/math/cells.hpp"
#include "device/affine_fit_int32.hpp"

namespace dotpose::core {
namespace {

/// Maximum number of dots sampled for the median displacement and the median residual. The sampled
/// dots are evenly spaced in the list of observations.
constexpr int kSample = 64;

/// Returns, for each symbol, the vector of the given length in the direction of the symbol.
std::array<FixedVec, 4> displacements(std::int32_t length) {
    std::array<FixedVec, 4> all;
    for (std::size_t s = 0; s < all.size(); ++s) {
        const auto symbol = static_cast<Symbol>(s);
        all[s] = {dx(symbol) * length, dy(symbol) * length};
    }
    return all;
}

/// Offset of a dot from its intersection, in 2^-16 spacings, and the symbol of the dot.
struct Offset {
    FixedVec q16;
    Symbol symbol;
};

std::int32_t squared_q16(FixedVec a_q16) {
    return (a_q16.x >> 8) * (a_q16.x >> 8) + (a_q16.y >> 8) * (a_q16.y >> 8);
}

/// Adds a point to the fit. This function is not inlined, because the caller would otherwise need
/// more registers than small processors have.
[[gnu::noinline]] void add(AffineFitInt32& fit, FixedVec p, FixedVec target) {
    fit.add(p, target);
}

}  // namespace

int fit_affine_pose(const Observations& observations, PlaneFromImage& pose,
                    std::int32_t& displacement_q16) {
    const Cells cells(pose);
    const auto offset_q16 = [&](const Observation& o, FixedVec p) {
        return cells.plane_point_q16(p) -
               FixedVec{o.pattern_step.x * 65536, o.pattern_step.y * 65536};
    };
    std::array<Offset, kSample> sample;
    std::size_t count = 0;
    observations.visit(
        [&](const Observation& o) {
            sample[count++] = {offset_q16(o, cells.from_centre_q3(o.image_point_q8)), o.symbol};
        },
        observations.count() / kSample + 1);
    const auto sampled_median = [&](auto value) {
        std::array<std::int32_t, kSample> values;
        for (std::size_t s = 0; s < count; ++s)
            values[s] = value(sample[s]);
        return median(std::span(values).first(count));
    };
    // The displacement is measured in each frame, because it depends on ink spread and blur.
    displacement_q16 = sampled_median([](const Offset& offset) {
        return offset.q16.x * dx(offset.symbol) + offset.q16.y * dy(offset.symbol);
    });
    const auto displaced_q16 = displacements(displacement_q16);
    const auto squared_residual_q16 = [&](FixedVec offset, Symbol symbol) {
        return squared_q16(offset - displaced_q16[static_cast<std::size_t>(symbol)]);
    };
    // Maximum squared residual of a dot in the fit: 12 times the median. For a two-dimensional
    // Gaussian, the median is 1.39 sigma^2, so residuals of up to 4.1 sigma are accepted. One dot
    // in 4,000 exceeds this limit by chance.
    const std::int32_t limit_q16 = 12 * sampled_median([&](const Offset& offset) {
                                       return squared_residual_q16(offset.q16, offset.symbol);
                                   }) +
                                   1;

    // Number of fractional bits in the targets, which are the printed positions of the dots. With 6
    // bits, the coordinates of targets are less than 2^15 in magnitude, as `AffineFitInt32`
    // requires.
    constexpr int kTargetBits = 6;
    const auto targets = displacements(shift_rounded(displacement_q16, 16 - kTargetBits));
    AffineFitInt32 fit;
    observations.visit([&](const Observation& o) {
        const FixedVec p = cells.from_centre_q3(o.image_point_q8);
        if (squared_residual_q16(offset_q16(o, p), o.symbol) > limit_q16) return;
        const FixedVec step{o.pattern_step.x * (1 << kTargetBits),
                            o.pattern_step.y * (1 << kTargetBits)};
        add(fit, p, step + targets[static_cast<std::size_t>(o.symbol)]);
    });
    return fit.solve(kTargetBits, pose) ? fit.count() : 0;
}

}  // namespace dotpose::core

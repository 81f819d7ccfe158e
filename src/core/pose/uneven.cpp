#include "core/pose/uneven.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/pose/dot_offsets.hpp"
#include "core/pose/float_fit.hpp"
#include "core/pose/slip.hpp"

namespace dotpose::core {
namespace {

/// Dots so many deviations off, squared, say nothing of what their neighbours are off.
constexpr float kOutlier = 16.6F;

/// What blocks of dots are off in common.
struct Blocks {
    static constexpr int kMostColumns = 8;
    static constexpr int kMostRows = 6;
    struct Block {
        float dots = 0;
        float off_x = 0;
        float off_y = 0;
    };
    std::array<Block, kMostColumns * kMostRows> all{};
    float dots = 0;
    float outliers = 0;
    float squares = 0;
    float side = 1;  ///< of a block, spacings

    float between() const {
        float sum = 0;
        for (const Block& b : all) {
            if (b.dots > 0) sum += (b.off_x * b.off_x + b.off_y * b.off_y) / b.dots;
        }
        return sum;
    }
    float freedom() const {
        constexpr float kFitted = 6;
        const auto used = std::ranges::count_if(all, [](const Block& b) { return b.dots > 0; });
        return std::max(2 * static_cast<float>(used) - kFitted, 1.0F);
    }
    /// Of one coordinate of a dot about the mean of its block.
    float variance_within() const {
        const auto used = std::ranges::count_if(all, [](const Block& b) { return b.dots > 0; });
        return std::max(squares - between(), 0.0F) /
                   std::max(2 * (dots - static_cast<float>(used)), 1.0F) +
               1e-12F;
    }
    /// By how many deviations blocks are off more than chance explains.
    float excess() const {
        const float f = freedom();
        return (between() / (f * variance_within()) - 1) * std::sqrt(f / 2);
    }
    /// Of what the dots of a block are off in common, along one axis.
    float variance_between() const {
        return std::max(between() - freedom() * variance_within(), 0.0F) / std::max(2 * dots, 1.0F);
    }
};

Blocks blocks_of(const MeasuredDots& dots, const FloatPlane& plane, const PoseFit& fit) {
    Blocks blocks;
    const auto count = static_cast<std::size_t>(dots.count);
    FloatVec least{kNoDot_px, kNoDot_px};
    FloatVec most{-kNoDot_px, -kNoDot_px};
    for (std::size_t k = 0; k < count; ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        least = {std::min(least.x, dots.x[k]), std::min(least.y, dots.y[k])};
        most = {std::max(most.x, dots.x[k]), std::max(most.y, dots.y[k])};
    }
    const int columns = fit.dots > 1000 ? 8 : 4;
    const int rows = columns * 3 / 4;
    const float per_x = static_cast<float>(columns) / (most.x - least.x + 1);
    const float per_y = static_cast<float>(rows) / (most.y - least.y + 1);
    blocks.side = 1 / (std::max(per_x, per_y) * spacing_px(plane));
    for (std::size_t k = 0; k < count; ++k) {
        if (dots.x[k] >= kNoDot_px) continue;
        const DotOffset dot = dot_offset(dots, k, plane, fit.displacement);
        if (dot.squared() > kOutlier * fit.variance) {
            blocks.outliers += 1;
            continue;
        }
        const auto column = static_cast<int>((dots.x[k] - least.x) * per_x);
        const auto row = static_cast<int>((dots.y[k] - least.y) * per_y);
        Blocks::Block& block = blocks.all[static_cast<std::size_t>(row * columns + column)];
        block.dots += 1;
        block.off_x += dot.off.x;
        block.off_y += dot.off.y;
        blocks.dots += 1;
        blocks.squares += dot.squared();
    }
    return blocks;
}

bool may_be_uneven(const Blocks& blocks) {
    constexpr float kLeastExcess = 2.5F;
    return blocks.excess() > kLeastExcess ||
           blocks.outliers > 3 + 0.02F * (blocks.dots + blocks.outliers);
}

/// Leaves the dots on one side of a line out of a fit: their cells are taken for others, far away.
class Without {
  public:
    enum class Side : std::uint8_t { beyond, here };

    Without(Side side, MeasuredDots& dots, const FloatPlane& plane, FloatVec reference_px,
            const Slip& slip)
        : dots_(dots) {
        // The line is known to a spacing or so.
        constexpr float kMargin = 0.8F;
        const float sign = side == Side::beyond ? 1 : -1;
        const FloatVec reference = plane_point(plane, reference_px);
        for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
            if (dots.x[k] >= kNoDot_px) continue;
            const FloatVec at = plane_point(plane, {dots.x[k], dots.y[k]});
            const float beyond = (at.x - reference.x) * slip.direction.x +
                                 (at.y - reference.y) * slip.direction.y - slip.distance;
            if (sign * beyond > -kMargin) dots.column[k] += kFar;
        }
    }
    Without(const Without&) = delete;
    Without& operator=(const Without&) = delete;
    ~Without() {
        for (std::size_t k = 0; k < static_cast<std::size_t>(dots_.count); ++k) {
            if (dots_.column[k] > kFar / 2) dots_.column[k] -= kFar;
        }
    }

  private:
    static constexpr float kFar = 1 << 20;
    MeasuredDots& dots_;
};

void add(float variance, std::size_t i, PoseFit& fit) {
    fit.uneven[i][i] += variance;
}

/// What dots that are off alike leave open.
void widen_by_blocks(const Blocks& blocks, PoseFit& fit) {
    constexpr float kLeastExcess = 4;
    if (blocks.excess() < kLeastExcess) return;
    constexpr float kOfPlace = 2;
    constexpr float kOfTurn = 2;
    const float variance = blocks.variance_between();
    add(kOfPlace * variance, 0, fit);
    add(kOfPlace * variance, 1, fit);
    add(kOfTurn * variance / (blocks.side * blocks.side), 2, fit);
    if (fit.surface == Surface::even) fit.surface = Surface::uneven;
}

/// Squared spacings within which dots of one side lie of a plane that is fitted to both.
constexpr float kFarOff = 0.04F;

/// What most of the dots near a point are off in common.
bool find_common_offset(const MeasuredDots& dots, const FloatPlane& plane, float displacement,
                        FloatVec near, FloatVec& common) {
    constexpr std::size_t kMost = 256;
    constexpr float kReach = 10;
    constexpr float kAlike = 0.08F * 0.08F;
    constexpr int kFewest = 8;
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
                return d.x * d.x + d.y * d.y < kAlike;
            });
        if (alike <= most) continue;
        most = static_cast<int>(alike);
        common = offsets[i];
    }
    return most >= kFewest;
}

/// The plane of what lies beyond a line. False if the dots there do not determine it.
bool fit_beyond(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px, const Slip& slip,
                const PoseFit& here, FloatPlane& plane) {
    const Without without(Without::Side::here, dots, plane, reference_px, slip);
    FloatVec common;
    if (!find_common_offset(dots, plane, here.displacement, plane_point(plane, reference_px),
                            common))
        return false;
    plane.at_x += common.x;
    plane.at_y += common.y;
    PoseFit fit = here;
    return fit_plane(kernels, dots, here.reach_px, kFarOff, here.displacement, plane, fit);
}

/// Where the line passes so near the reference point that either side may hold it.
void widen_by_slip(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   const FloatPlane& plane, const Slip& slip, PoseFit& fit) {
    constexpr float kNear = 1.2F;
    if (slip.distance > kNear) return;
    FloatPlane beyond = plane;
    if (!fit_beyond(kernels, dots, reference_px, slip, fit, beyond)) {
        // It lies anywhere in its cell, and turned by up to some degrees.
        add(1.0F / 12, 0, fit);
        add(1.0F / 12, 1, fit);
        add(0.02F * 0.02F, 2, fit);
        return;
    }
    const FloatVec p = plane_point(plane, reference_px);
    const FloatVec q = plane_point(beyond, reference_px);
    const FloatVec s{q.x - p.x, q.y - p.y};
    const float turn = (plane.du_x * beyond.du_y - plane.du_y * beyond.du_x) /
                       (plane.du_x * plane.du_x + plane.du_y * plane.du_y);
    add(s.x * s.x, 0, fit);
    add(s.y * s.y, 1, fit);
    fit.uneven[0][1] += s.x * s.y;
    fit.uneven[1][0] += s.x * s.y;
    add(turn * turn, 2, fit);
}

/// Fits the plane to this side of the likeliest line. False, with all as it was, if none divides
/// the sheet.
bool fit_this_side(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   FloatPlane& plane, PoseFit& fit, Slip& slip) {
    constexpr float kCertain = 23;
    constexpr float kPossible = 6;
    FloatPlane better = plane;
    PoseFit of_side = fit;
    for (int round = 0; round < 3; ++round) {
        slip = find_slip(dots, better, of_side, reference_px);
        if (slip.gain < kPossible) return false;
        const Without without(Without::Side::beyond, dots, better, reference_px, slip);
        if (!fit_plane(kernels, dots, fit.reach_px, kFarOff, fit.displacement, better, of_side))
            return false;
    }
    if (slip.gain < kCertain) return false;
    plane = better;
    fit = of_side;
    return true;
}

}  // namespace

void fit_uneven(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                FloatPlane& plane, PoseFit& fit) {
    fit.surface = Surface::even;
    fit.uneven = {};
    Blocks blocks = blocks_of(dots, plane, fit);
    if (!may_be_uneven(blocks)) return;
    Slip slip;
    if (fit_this_side(kernels, dots, reference_px, plane, fit, slip)) {
        fit.surface = Surface::divided;
        widen_by_slip(kernels, dots, reference_px, plane, slip, fit);
        const Without without(Without::Side::beyond, dots, plane, reference_px, slip);
        blocks = blocks_of(dots, plane, fit);
    }
    widen_by_blocks(blocks, fit);
}

void fit_uneven(const Kernels& kernels, const Observations& observations, Vec reference_q8,
                MeasuredDots& dots, PlaneFromImage& plane, PoseFit& fit) {
    fit.surface = Surface::even;
    fit.uneven = {};
    if (observations.count() > dots.capacity()) return;
    const auto from_centre_px = [&](Vec point_q8) {
        const Vec p = point_q8 - plane.centre_q8;
        return FloatVec{static_cast<float>(p.x) / 256, static_cast<float>(p.y) / 256};
    };
    dots.count = 0;
    observations.visit([&](const Observation& o) {
        const auto k = static_cast<std::size_t>(dots.count++);
        const FloatVec px = from_centre_px(o.image_point_q8);
        dots.x[k] = px.x;
        dots.y[k] = px.y;
        dots.column[k] = static_cast<float>(o.pattern_step.x);
        dots.row[k] = static_cast<float>(o.pattern_step.y);
        dots.bits[k] = static_cast<std::int32_t>(o.symbol);
    });
    // Kernels take eight at once.
    for (std::size_t k = 0; k < 8; ++k)
        dots.x[static_cast<std::size_t>(dots.count) + k] = kNoDot_px;
    FloatPlane better = float_plane(plane);
    fit_uneven(kernels, dots, from_centre_px(reference_q8), better, fit);
    if (fit.surface == Surface::divided) plane = fixed_plane(better, plane.centre_q8);
}

}  // namespace dotpose::core

#include "core/pose/uneven.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/pose/dot_offsets.hpp"
#include "core/pose/sides.hpp"

namespace dotpose::core {
namespace {

/// Dots so many deviations off, squared, say nothing of what their neighbours are off.
constexpr float kOutlier = 16.6F;

/// What blocks of dots are off in common.
struct Blocks {
    static constexpr int kMostColumns = 9;
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
    const int columns = fit.dots > 1000 ? 9 : 6;
    const int rows = columns * 2 / 3;
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

/// By so many deviations blocks may be off more than chance explains. Of honest frames 3 % exceed
/// the one, and hardly one in 1,000 the other.
constexpr float kSuspect = 2.5F;
constexpr float kUneven = 5;

bool may_be_uneven(const Blocks& blocks) {
    return blocks.excess() > kSuspect ||
           blocks.outliers > 3 + 0.02F * (blocks.dots + blocks.outliers);
}

/// Of the dots on this side of a line.
Blocks blocks_here(MeasuredDots& dots, FloatVec reference_px, const Sides& sides) {
    const OneSide only(OneSide::Side::here, dots, sides.plane, reference_px, sides.slip);
    return blocks_of(dots, sides.plane, sides.fit);
}

/// What it leaves open that the pose may be that of either plane.
void add_difference(const FloatPlane& plane, const FloatPlane& other, FloatVec reference_px,
                    float weight, PoseFit& fit) {
    const FloatVec p = plane_point(plane, reference_px);
    const FloatVec q = plane_point(other, reference_px);
    const float x = q.x - p.x;
    const float y = q.y - p.y;
    const float turn = (plane.du_x * other.du_y - plane.du_y * other.du_x) /
                       (plane.du_x * plane.du_x + plane.du_y * plane.du_y);
    fit.uneven[0][0] += weight * x * x;
    fit.uneven[1][1] += weight * y * y;
    fit.uneven[0][1] += weight * x * y;
    fit.uneven[1][0] += weight * x * y;
    fit.uneven[2][2] += weight * turn * turn;
}

void add(float variance, std::size_t i, PoseFit& fit) {
    fit.uneven[i][i] += variance;
}

/// What dots that are off alike leave open.
void widen_by_blocks(const Blocks& blocks, PoseFit& fit) {
    constexpr float kOfPlace = 2;
    constexpr float kOfTurn = 8;
    const float variance = blocks.variance_between();
    add(kOfPlace * variance, 0, fit);
    add(kOfPlace * variance, 1, fit);
    add(kOfTurn * variance / (blocks.side * blocks.side), 2, fit);
    fit.surface = Surface::uneven;
}

/// Where the line passes so near the reference point that either side may hold it.
void widen_near_line(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                     const Sides& sides, PoseFit& fit) {
    constexpr float kNear = 1.2F;
    if (sides.slip.distance > kNear) return;
    FloatPlane beyond;
    if (fit_far_side(kernels, dots, reference_px, sides, beyond))
        return add_difference(sides.plane, beyond, reference_px, 1, fit);
    // It lies anywhere in its cell, and turned by up to some degrees.
    add(1.0F / 12, 0, fit);
    add(1.0F / 12, 1, fit);
    add(0.02F * 0.02F, 2, fit);
}

/// Fits to the reference point's side if a line divides the sheet for sure, and that is all that is
/// uneven of it. Where a line may, it is left open which fit is right.
void consider_line(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   const Blocks& blocks, FloatPlane& plane, PoseFit& fit) {
    Sides sides{plane, fit};
    const bool has_line = fit_this_side(kernels, dots, reference_px, sides);
    const bool is_divided = has_line && sides.slip.gain > Slip::kCertain;
    if (is_divided && blocks_here(dots, reference_px, sides).excess() < kSuspect) {
        plane = sides.plane;
        fit = sides.fit;
        fit.surface = Surface::divided;
    } else {
        if (is_divided || blocks.excess() > kUneven) widen_by_blocks(blocks, fit);
        if (!has_line) return;
        const float weight =
            (sides.slip.gain - Slip::kPossible) / (Slip::kCertain - Slip::kPossible);
        add_difference(plane, sides.plane, reference_px, std::min(weight, 1.0F), fit);
    }
    if (is_divided) widen_near_line(kernels, dots, reference_px, sides, fit);
}

}  // namespace

void fit_uneven(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                FloatPlane& plane, PoseFit& fit) {
    fit.surface = Surface::even;
    fit.uneven = {};
    const Blocks blocks = blocks_of(dots, plane, fit);
    if (may_be_uneven(blocks)) consider_line(kernels, dots, reference_px, blocks, plane, fit);
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

#include "core/pose/uneven.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/pose/group_scatter.hpp"
#include "core/pose/split_fit.hpp"
#include "core/pose/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::uneven;

int blocks_along(int dots) {
    if (dots > tuned::kManyDots) return static_cast<int>(BlockSums::kMaxAlong);
    int along = tuned::kMinAlong;
    while (along < tuned::kFewAlong && dots >= tuned::kDotsPerBlock * (along + 1) * (along + 1))
        ++along;
    return along;
}

/// Scatter of the residuals between and within image blocks.
class Blocks {
  public:
    Blocks(const Kernels& kernels, const MeasuredDots& dots, const FloatPlane& plane,
           const PoseFit& fit) {
        const int side = blocks_along(fit.dots);
        const auto reach_px = static_cast<float>(fit.reach_px);
        const BlockSums sums = kernels.sum_blocks(
            dots, plane, fit.displacement, tuning::fit::kOutlier * fit.variance, reach_px, side);
        const float spacing = spacing_px(plane);
        side_ = 2 * reach_px / (static_cast<float>(side) * spacing);
        const float bias = tuned::kPixelBias_px / spacing;
        variance_of_bias_ = bias * bias;
        BlockSums::Block all{};
        for (int b = 0; b < side * side; ++b) {
            const BlockSums::Block& block = sums.all[static_cast<std::size_t>(b)];
            all.sums += block.sums;
            if (block.inliers() == 0) continue;
            scatter_.between +=
                (block.off_x() * block.off_x() + block.off_y() * block.off_y()) / block.inliers();
            scatter_.groups += 1;
        }
        scatter_.squares = sums.squares;
        scatter_.dots = all.inliers();
        outliers_ = all.dots() - all.inliers();
    }

    const GroupScatter& scatter() const { return scatter_; }
    float outliers() const { return outliers_; }
    float side() const { return side_; }  ///< side of a block, in spacings
    /// Returns the variance of the block displacements along one axis, in spacings^2, after
    /// subtracting the variance due to pixel bias. The result is at least 0.
    float variance_of_sheet() const {
        return std::max(scatter_.variance_between() - variance_of_bias_, 0.0F);
    }

  private:
    GroupScatter scatter_;
    float outliers_;
    float side_;
    float variance_of_bias_;
};

/// Computes the blocks from the dots on the reference point's side of the line.
Blocks blocks_here(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   const SplitFit& split) {
    const HalfPlane only(HalfPlane::Side::here, dots, split.plane, reference_px, split.step);
    return {kernels, dots, split.plane, split.fit};
}

bool has_outliers(const Blocks& blocks) {
    return blocks.outliers() >
           tuned::kFewOutliers + tuned::kOutlierFraction * blocks.scatter().dots;
}

/// Increases the covariance by `weight` times the squared difference between the poses of two
/// planes at the reference point. Either plane may be correct, so the difference is treated as a
/// possible error of the pose.
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

/// Adds the variance of position and angle due to block displacements. The displacement variance is
/// estimated from the mean block residuals.
void widen_by_blocks(const Blocks& blocks, PoseFit& fit) {
    const float variance = blocks.variance_of_sheet();
    add(tuned::kOfPlace * variance, 0, fit);
    add(tuned::kOfPlace * variance, 1, fit);
    add(tuned::kOfTurn * variance / (blocks.side() * blocks.side()), 2, fit);
}

/// Increases the covariance if the reference point is so close to the dividing line that it may be
/// on either side.
void widen_near_line(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                     const SplitFit& split, PoseFit& fit) {
    if (split.step.distance > tuned::kNearLine) return;
    FloatPlane beyond;
    if (fit_far_side(kernels, dots, reference_px, split, beyond))
        return add_difference(split.plane, beyond, reference_px, 1, fit);
    // The plane beyond the line is unknown. Its displacement is assumed to be uniformly distributed
    // between -1/2 and 1/2 cell, which has a variance of 1/12. Its rotation is assumed to have a
    // standard deviation of 0.02 rad.
    add(1.0F / 12, 0, fit);
    add(1.0F / 12, 1, fit);
    add(0.02F * 0.02F, 2, fit);
}

/// Handles a sheet that may be divided by a line:
/// - If a line with a gain above PaperStep::kCertain was found, and the dots on the reference
///   point's side are in one plane, replaces the plane with a fit to this side, and sets the
///   surface to divided.
/// - Otherwise, keeps the plane, and sets the surface to uneven if the gain exceeds kCertain or if
///   the scatter between blocks exceeds kUneven. If a line was found, a plane has also been fitted
///   to the reference point's side. In this case, adds the squared difference between the poses of
///   the two planes to the covariance.
///
/// In both cases, also increases the covariance if the blocks may be displaced, or if the gain
/// exceeds kCertain and the line is close to the reference point.
void consider_line(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                   const Blocks& blocks, FloatPlane& plane, PoseFit& fit) {
    SplitFit split{plane, fit};
    const bool has_line = fit_this_side(kernels, dots, reference_px, split);
    const bool is_divided = has_line && split.step.gain > PaperStep::kCertain;
    if (is_divided &&
        blocks_here(kernels, dots, reference_px, split).scatter().excess() < tuned::kSuspect) {
        plane = split.plane;
        fit = split.fit;
        fit.surface = Surface::divided;
        // Without outliers, the sheet may be bent instead of divided, so the blocks may be
        // displaced.
        if (!has_outliers(blocks)) widen_by_blocks(blocks, fit);
    } else {
        const float excess = blocks.scatter().excess();
        if (is_divided || excess > tuned::kUneven) fit.surface = Surface::uneven;
        if (is_divided || excess > tuned::kShared) widen_by_blocks(blocks, fit);
        if (!has_line) return;
        add_difference(plane, split.plane, reference_px, 1, fit);
    }
    if (is_divided) widen_near_line(kernels, dots, reference_px, split, fit);
}

/// Returns true if there are many outliers, or if `GroupScatter::excess` of the blocks exceeds
/// `min_excess`.
bool may_be_divided(const Blocks& blocks, float min_excess) {
    return blocks.scatter().excess() > min_excess || has_outliers(blocks);
}

/// Searches for a line if the sheet may be divided (see `may_be_divided`). Otherwise, increases the
/// covariance if the scatter between blocks exceeds kShared.
void fit_uneven_from(float min_excess, const Kernels& kernels, MeasuredDots& dots,
                     const Blocks& blocks, FloatVec reference_px, FloatPlane& plane, PoseFit& fit) {
    if (may_be_divided(blocks, min_excess))
        consider_line(kernels, dots, reference_px, blocks, plane, fit);
    else if (blocks.scatter().excess() > tuned::kShared)
        widen_by_blocks(blocks, fit);
}

/// Returns the limit on `GroupScatter::excess` above which the second attempt searches for a line.
/// The limit increases with the number of dots, because with many dots, even the small block
/// residuals of a flat sheet (for example, due to pixel bias) are significant. The residuals at a
/// dividing line also become more significant with the number of dots, so they still exceed the
/// limit.
float patient_excess(const Blocks& blocks) {
    return tuned::kMaybeLine *
           std::sqrt(std::max(blocks.scatter().dots / tuned::kMaybeLineDots, 1.0F));
}

}  // namespace

bool may_be_divided(const Kernels& kernels, const MeasuredDots& dots, const FloatPlane& plane,
                    const PoseFit& fit) {
    return may_be_divided(Blocks(kernels, dots, plane, fit), tuned::kSuspect);
}

void fit_uneven(const Kernels& kernels, MeasuredDots& dots, FloatVec reference_px,
                FloatPlane& plane, PoseFit& fit) {
    fit.surface = Surface::even;
    fit.uneven = {};
    const Blocks blocks(kernels, dots, plane, fit);
    fit_uneven_from(tuned::kSuspect, kernels, dots, blocks, reference_px, plane, fit);
}

void fit_uneven(const Kernels& kernels, const Observations& observations, FixedVec reference_q8,
                MeasuredDots& dots, PlaneFromImage& plane, PoseFit& fit) {
    fit.surface = Surface::even;
    fit.uneven = {};
    if (observations.count() > dots.capacity()) return;
    const auto from_centre_px = [&](FixedVec point_q8) {
        const FixedVec p = point_q8 - plane.centre_q8;
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
    // Pads the arrays, because the kernels process eight dots at a time.
    for (std::size_t k = 0; k < 8; ++k)
        dots.x[static_cast<std::size_t>(dots.count) + k] = kNoDot_px;
    FloatPlane better = float_plane(plane);
    const Blocks blocks(kernels, dots, better, fit);
    fit_uneven_from(patient_excess(blocks), kernels, dots, blocks, from_centre_px(reference_q8),
                    better, fit);
    if (fit.surface == Surface::divided) plane = fixed_plane(better, plane.centre_q8);
}

}  // namespace dotpose::core

#include "locate/dot_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/pose/facing_dots.hpp"
#include "core/pose/pixel_bias.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::confirm;

/// Prefetches the pixels in view if they occupy kMinFetched_bytes to kMaxFetched_bytes. A new
/// camera image is not in the cache, and hardware prefetchers do not recognise the order in which
/// the pixels are read.
void fetch_pixels(const ImageView& image, const CellsInView& view) {
    constexpr std::ptrdiff_t kLine_bytes = 64;
    const auto range = [&](float centre, int size_px) {
        const auto limit = static_cast<float>(size_px);
        return std::pair{
            static_cast<std::ptrdiff_t>(std::clamp(centre - view.reach_px, 0.0F, limit)),
            static_cast<std::ptrdiff_t>(std::clamp(centre + view.reach_px, 0.0F, limit))};
    };
    const auto [left, right] = range(view.centre_x, image.width_px);
    const auto [top, bottom] = range(view.centre_y, image.height_px);
    const std::ptrdiff_t bytes = (right - left) * (bottom - top);
    if (bytes < tuned::kMinFetched_bytes || bytes > tuned::kMaxFetched_bytes) return;
    for (std::ptrdiff_t v = top; v < bottom; ++v) {
        const std::uint8_t* row = image.row(static_cast<int>(v));
        for (std::ptrdiff_t u = left; u < right; u += kLine_bytes)
            __builtin_prefetch(row + u);
    }
}

/// Drops windows that are much darker than the paper. Such windows are beyond the edge of the
/// sheet, for example on a dark table, where noise can look like dots. `paper` is the mean level
/// around dots. If `paper` is 0, drops nothing and sets `paper` to the measured level.
void drop_table(MeasuredDots& dots, float& paper) {
    float sum = 0;
    float count = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots.count); ++k) {
        const auto level = static_cast<float>(dots.paper[k]);
        if (level < tuned::kTable * paper) dots.x[k] = kNoDot_px;
        if (dots.x[k] >= kNoDot_px) continue;
        sum += level;
        count += 1;
    }
    if (paper == 0 && count > 0) paper = sum / count;
}

float dot_radius_px(const Hypothesis& hypothesis) {
    constexpr float kPi = 3.14159265F;
    const float beyond_cut =
        static_cast<float>(hypothesis.dot_contrast_q8 * (256 - kContrastCut_q8)) / 65536;
    return std::sqrt(hypothesis.typical_mass / (kPi * std::max(beyond_cut, 1.0F / 256)));
}

/// Returns the radius of the centroid window, in px. The radius is small enough to limit noise, and
/// large enough to include the edge of the dot.
float window_radius_px(const Hypothesis& hypothesis) {
    const bool is_fine =
        spacing_px(hypothesis.pattern_from_image) < tuned::kMaxSpacingForSmallWindow_px;
    return std::clamp(tuned::kWindowRadii * dot_radius_px(hypothesis), tuned::kMinWindowRadius_px,
                      is_fine ? kSmallCentroidRadius_px : kMaxCentroidRadius_px);
}

/// Returns true if all dots of a row, or all dots of a column, have nearly the same sub-pixel
/// phase. This is the case if the step between adjacent cells is within `max_off_px` of a whole
/// number of pixels, along u and along v.
bool has_common_phase(const FloatPlane& p, float max_off_px) {
    const float by = 1 / (p.du_x * p.dv_y - p.dv_x * p.du_y);
    const auto is_whole = [&](float px) {
        return std::abs(px - std::floor(px + 0.5F)) < max_off_px;
    };
    return (is_whole(by * p.dv_y) && is_whole(by * p.dv_x)) ||
           (is_whole(by * p.du_y) && is_whole(by * p.du_x));
}

/// Returns half the side of the window around an intersection, in spacings. The window of a square
/// cell includes all four possible dot positions of the cell, but not the dots of other cells. If a
/// rolling shutter stretches the cells, the window shrinks in proportion to the shorter side of a
/// cell.
float window_reach(const FloatPlane& p) {
    constexpr float kReach = 0.36F;
    const float spacing = spacing_px(p);
    // The matrix of the plane has the determinant 1 / spacing^2. The sides of a cell, in px, are
    // therefore spacing^2 times the lengths of the rows of this matrix.
    const float shorter_side = spacing * std::sqrt(std::min(p.du_x * p.du_x + p.dv_x * p.dv_x,
                                                            p.du_y * p.du_y + p.dv_y * p.dv_y));
    return shorter_side < tuned::kMinSideOfSquare ? shorter_side * kReach : kReach;
}

}  // namespace

bool can_sample_directly(const Hypothesis& hypothesis) {
    const float spacing = spacing_px(hypothesis.pattern_from_image);
    return spacing >= tuned::kMinSpacingForDirectSampling_px &&
           spacing < tuned::kMaxSpacingForSmallWindow_px &&
           !has_common_phase(hypothesis.pattern_from_image, tuned::kDrift_px);
}

bool may_be_biased(const FloatPlane& plane, float variance_px2, int side_px) {
    if (variance_px2 > tuned::kMaxVariance_px2) return false;
    // Phase difference between adjacent dots, in px, if the phase changes by kDriftInView_px across
    // the view.
    const float drift_px = tuned::kDriftInView_px * spacing_px(plane) / static_cast<float>(side_px);
    return has_common_phase(plane, drift_px);
}

WindowOptions DotReader::window_options(const Hypothesis& hypothesis) const {
    return {spacing_px_, window_reach(hypothesis.pattern_from_image),
            hypothesis.dot_contrast_q8 * kContrastCut_q8 >> 8};
}

BitsRead DotReader::read(const CellsInView& view, Hypothesis& hypothesis, BitBlock* block) {
    fetch_pixels(image_, view);
    BitLines* const columns = block != nullptr ? &block->columns : nullptr;
    BitLines* const rows = block != nullptr ? &block->rows : nullptr;
    if (hypothesis.is_exact)
        return kernels_.read_levels(image_, view, hypothesis.dot_contrast_q8, dots_, columns, rows);
    WindowOptions window = window_options(hypothesis);
    window.is_partial_view = hypothesis.is_partial_view;
    // In later rounds of a partial view, most windows may be empty. A typical mass estimated from
    // empty windows would be wrong, so these rounds use the typical mass of the first round.
    if (hypothesis.is_partial_view) window.typical_mass = typical_mass_;
    typical_mass_ = hypothesis.typical_mass = kernels_.measure_windows(image_, view, window, dots_);
    if (hypothesis.is_partial_view) drop_table(dots_, paper_);
    return kernels_.read_bits(dots_, hypothesis.pattern_from_image, hypothesis.displacement,
                              columns, rows);
}

BitsRead DotReader::read_again(const Hypothesis& hypothesis, BitBlock& block) const {
    block = {};
    return kernels_.read_bits(dots_, hypothesis.pattern_from_image, hypothesis.displacement,
                              &block.columns, &block.rows);
}

void DotReader::drop_cut_dots(const Hypothesis& hypothesis) const {
    if (!hypothesis.reads_cut_dots) return;
    const float margin_px = margin_of_whole_dots_px(spacing_px_);
    const auto is_cut = [&](std::int32_t window, std::int32_t sum, std::int32_t mass, int size_px) {
        const float at =
            static_cast<float>(window) + static_cast<float>(sum) / static_cast<float>(mass);
        return at < margin_px || at > static_cast<float>(size_px - 1) - margin_px;
    };
    for (std::size_t k = 0; k < static_cast<std::size_t>(dots_.count); ++k) {
        if (dots_.x[k] < kNoDot_px &&
            (is_cut(dots_.window_u[k], dots_.sum_u[k], dots_.mass[k], image_.width_px) ||
             is_cut(dots_.window_v[k], dots_.sum_v[k], dots_.mass[k], image_.height_px)))
            dots_.x[k] = kNoDot_px;
    }
}

void DotReader::find_centres(const CellsInView& view, Hypothesis& hypothesis, bool is_last,
                             BitsRead& bits) const {
    if (hypothesis.is_exact) {
        bits.right = 0;
        const DotOffsets found = kernels_.find_centres(image_, view, tuned::kMaxOff_px, 0, dots_);
        if (found.points < tuned::kMinFound) return;
        FloatPlane& plane = hypothesis.pattern_from_image;
        const auto points = static_cast<float>(found.points);
        bits.right = found.points;
        // Sums the distances of the dots from their intersections along the direction of the coded
        // displacement, in spacings. Each distance is the predicted displacement plus the
        // projection of the dot's measured offset, converted from px to spacings.
        bits.projected = points * hypothesis.displacement + plane.du_x * found.of_x[0] +
                         plane.dv_x * found.of_x[1] + plane.du_y * found.of_y[0] +
                         plane.dv_y * found.of_y[1];
        const Similarity motion = similarity_of(found);
        bits.squares =
            motion.squares_px2 * std::abs(plane.du_x * plane.dv_y - plane.dv_x * plane.du_y);
        plane = moved(plane, motion);
    } else if (is_last) {
        kernels_.refine_centres(image_, view, window_radius_px(hypothesis), dots_);
    }
}

bool DotReader::correct_pixel_bias(const CellsInView& view, const Hypothesis& hypothesis,
                                   const PoseFit& fit, FloatVec& remaining_px2) const {
    // The bias averages out if the dots have different sub-pixel phases. The phases differ if the
    // lens has distortion. They also differ if the dots are sampled directly, because
    // `can_sample_directly` requires different phases.
    if (hypothesis.is_exact || view.lens.k != 0) return false;
    const float variance_px2 =
        fit.variance * spacing_px_ * spacing_px_ / static_cast<float>(fit.dots);
    if (!may_be_biased(hypothesis.pattern_from_image, variance_px2,
                       std::max(image_.width_px, image_.height_px))) {
        return false;
    }
    const CentroidWindow window{
        window_radius_px(hypothesis), dot_radius_px(hypothesis), {view.centre_x, view.centre_y}};
    recentre_windows(image_, window, dots_);
    kernels_.refine_centres(image_, view, window.radius_px, dots_);
    remaining_px2 =
        core::correct_pixel_bias(image_, window, hypothesis.pattern_from_image, fit, dots_);
    return true;
}

bool DotReader::correct_neighbour_bias(const Hypothesis& hypothesis, const PoseFit& fit) const {
    const float between_px = spacing_px_ * (1 - 2 * fit.displacement);
    return !hypothesis.is_exact && window_radius_px(hypothesis) > tuned::kFacing * between_px &&
           core::correct_neighbour_bias(hypothesis.pattern_from_image, fit, dots_);
}

}  // namespace dotpose::core

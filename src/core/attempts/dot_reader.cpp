#include "core/attempts/dot_reader.hpp"

#include <algorithm>
#include <cmath>

#include "core/attempts/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::confirm;

/// Drops windows that are much darker than paper, because they show the table beyond the sheet,
/// where noise is as dark as dots. `paper` is the mean level around dots, once it is known.
void leave_out_table(MeasuredDots& dots, float& paper) {
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

/// Returns the reach in px of the bell that weights the pixels of a dot: small, against noise, but
/// as far as the edge of a dot is seen.
float bell_reach_px(const Hypothesis& hypothesis) {
    constexpr float kPi = 3.14159265F;
    const float beyond_cut =
        static_cast<float>(hypothesis.depth_q8 * (256 - kCutOfDepth_q8)) / 65536;
    const float radius_px =
        std::sqrt(hypothesis.typical_mass / (kPi * std::max(beyond_cut, 1.0F / 256)));
    const bool is_quick = spacing_px(hypothesis.pattern_from_image) < tuned::kQuickBells_px;
    return std::clamp(tuned::kBellRadii * radius_px, tuned::kLeastBell_px,
                      is_quick ? kQuickBellReach_px : kMostBellReach_px);
}

/// Whether all dots in view fall on the pixels alike, along u or v, because the grid's steps are
/// whole pixels. The error of a single look at each dot does not average out then.
bool falls_on_pixels_alike(const FloatPlane& p) {
    const float by = 1 / (p.du_x * p.dv_y - p.dv_x * p.du_y);
    const auto is_whole = [](float px) {
        return std::abs(px - std::floor(px + 0.5F)) < tuned::kDrift_px;
    };
    return (is_whole(by * p.dv_y) && is_whole(by * p.dv_x)) ||
           (is_whole(by * p.du_y) && is_whole(by * p.du_x));
}

}  // namespace

bool suits_one_pass(const Hypothesis& hypothesis) {
    const float spacing = spacing_px(hypothesis.pattern_from_image);
    return spacing >= tuned::kFinestOnePass_px && spacing < tuned::kQuickBells_px &&
           !falls_on_pixels_alike(hypothesis.pattern_from_image);
}

void DotReader::sample_some(CellsInView view, Hypothesis& hypothesis) {
    const float cells = view.width_px * view.height_px / (spacing_px_ * spacing_px_);
    view.step = std::max(static_cast<int>(cells / tuned::kSomeDots), 1);
    kernels_.list_cells(view, dots_);
    hypothesis.typical_mass =
        kernels_.measure_windows(image_, view, window_options(hypothesis), dots_);
}

WindowOptions DotReader::window_options(const Hypothesis& hypothesis) const {
    return {spacing_px_, 0.36F, hypothesis.depth_q8 * kCutOfDepth_q8 >> 8};
}

BitsRead DotReader::read(const CellsInView& view, Hypothesis& hypothesis, BitBlock* block) {
    BitLines* const columns = block != nullptr ? &block->columns : nullptr;
    BitLines* const rows = block != nullptr ? &block->rows : nullptr;
    if (hypothesis.is_exact)
        return kernels_.read_levels(image_, view, hypothesis.depth_q8, dots_, columns, rows);
    WindowOptions window = window_options(hypothesis);
    // Away from the centre most windows may be empty, so their own typical mass is not used.
    if (hypothesis.shows_part) window.typical_mass = typical_mass_;
    typical_mass_ = hypothesis.typical_mass = kernels_.measure_windows(image_, view, window, dots_);
    if (hypothesis.shows_part) leave_out_table(dots_, paper_);
    return kernels_.read_bits(dots_, hypothesis.pattern_from_image, hypothesis.displacement,
                              columns, rows);
}

BitsRead DotReader::read_again(const Hypothesis& hypothesis, BitBlock& block) const {
    block = {};
    return kernels_.read_bits(dots_, hypothesis.pattern_from_image, hypothesis.displacement,
                              &block.columns, &block.rows);
}

void DotReader::find_centres(const CellsInView& view, const Hypothesis& hypothesis, bool is_last,
                             BitsRead& bits) const {
    if (hypothesis.is_exact) {
        kernels_.find_centres(image_, view, bell_reach_px(hypothesis), tuned::kMostOff_px, dots_);
        const BitsRead found = kernels_.read_bits(dots_, hypothesis.pattern_from_image,
                                                  hypothesis.displacement, nullptr, nullptr);
        bits.right = found.right;
        bits.projected = found.projected;
        bits.squares = found.squares;
    } else if (is_last) {
        kernels_.refine_centres(image_, view, bell_reach_px(hypothesis), dots_);
    }
}

}  // namespace dotpose::core

#include "locate/patch_hypothesis.hpp"

#include <algorithm>

#include "core/decode/bit_lines.hpp"
#include "core/detect/patch.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {

void undistort(const FixedLens& lens, FloatVec middle, PatchDots& dots) {
    if (lens.k_q40 == 0) return;
    const FloatLens l = float_lens(lens);
    for (std::size_t i = 0; i < static_cast<std::size_t>(dots.count); ++i) {
        const float x = dots.x[i] + middle.x - l.centre_x;
        const float y = dots.y[i] + middle.y - l.centre_y;
        const float by = 1 / (1 + l.k * (x * x + y * y));
        dots.x[i] = x * by + l.centre_x - middle.x;
        dots.y[i] = y * by + l.centre_y - middle.y;
    }
}

FloatVec middle_of(const Patch& patch, const ImageView& image) {
    return {middle_u_px(patch) - static_cast<float>(image.width_px - 1) / 2,
            middle_v_px(patch) - static_cast<float>(image.height_px - 1) / 2};
}

bool place_patch(const ImageView& image, FixedVec around_px, int scale, Patch& patch) {
    return place_patch(image, around_px.x, around_px.y, tuning::first::kPatchWidth_px * scale,
                       tuning::first::kPatchHeight_px * scale, scale, patch);
}

bool place_patch_in_middle(const ImageView& image, int scale, Patch& patch) {
    return place_patch(image, {image.width_px / 2, image.height_px / 2}, scale, patch);
}

bool find_patch_dots(const Frame& frame, Patch& patch, Fix& fix, DotTiles tiles) {
    patch.dots.count = 0;
    frame.kernels.fill_patch(frame.image, patch);
    frame.kernels.smooth_patch(patch);
    if (!measure_contrast(patch, tiles)) return false;
    frame.kernels.find_minima(patch);
    fix.dots_seen = std::max(fix.dots_seen, patch.dots.count);
    const bool are_few = fix.dots_seen < std::max(frame.min_dots, 1);
    fix.status = are_few ? Status::too_few_dots : Status::no_grid;
    return true;
}

std::optional<Hypothesis> read_grid(const Patch& patch, const PatchGrid& grid, FloatVec from_centre,
                                    const PlaceEvidence& evidence, PlaceSearch search) {
    BitBlock block;
    evidence.kernels.read_cells(patch.dots, grid.grid_from_image, grid.displacement, block.columns,
                                block.rows);
    if (!join_earlier(grid.grid_from_image, from_centre, evidence.earlier, block)) return {};
    namespace tuned = tuning::patch_grid;
    if (grid.variance > tuned::kMaxVariance || patch.dots.count > tuned::kMaxDotsForThoroughSearch)
        search = PlaceSearch::brief;
    const auto found = find_turned_place(evidence, block, search);
    if (!found) return {};
    return Hypothesis{.pattern_from_image = turned(found->quarters, grid.grid_from_image),
                      .from_centre = from_centre,
                      .place = found->place,
                      .displacement = grid.displacement,
                      .dot_contrast_q8 = patch.dot_contrast_q8};
}

std::optional<Hypothesis> read_hypothesis(const Patch& patch, const PatchView& view,
                                          FloatVec from_centre, const PlaceEvidence& evidence) {
    PatchGrid grid;
    if (!find_grid(evidence.kernels, patch, view, grid)) return {};
    return read_grid(patch, grid, from_centre, evidence, PlaceSearch::brief);
}

}  // namespace dotpose::core

#include "locate/patch_hypothesis.hpp"

#include <algorithm>

#include "core/decode/bit_lines.hpp"
#include "core/decode/exact_lines.hpp"
#include "core/detect/patch.hpp"
#include "core/integrity/known_places.hpp"
#include "locate/on_sheets.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

constexpr int kPatchWidth_px = tuning::first::kPatchWidth_px;
constexpr int kPatchHeight_px = tuning::first::kPatchHeight_px;

/// Finds the quarter turn of a block of bits, and the place in the code of cell (0, 0) of the
/// turned block. Prefers places on known sheets. Returns false if no place is found.
bool find_turn_and_place(const Kernels& kernels, const DeviceOptions& options,
                         const BitBlock& block, DesktopWorkspace& w, int& quarters, Place& place) {
    quarters = likeliest_turn(kernels, block);
    const BitBlock upright = turned(quarters, block);
    const bool is_exact = find_place_exactly(options.code, upright, place);
    if (w.known.any() && !(is_exact && shows_sheet(w.known, options.code, place, upright))) {
        if (const auto found = find_place_on_sheets(kernels, options, block, w.known)) {
            quarters = found->quarters;
            place = found->place;
            return true;
        }
        if (w.known.are_all()) return false;
    }
    return is_exact ||
           find_place(options.code, score_block(kernels, upright, w.line_scores), place);
}

/// In a series of frames, stores the bits of the current frame. If the frames are read together,
/// also replaces the bits with the bits of all frames, and returns false if their grids do not
/// match. The plane is relative to `from_centre`.
bool join_earlier(const FloatPlane& grid_from_image, FloatVec from_centre, DesktopWorkspace& w,
                  BitBlock& block) {
    EarlierBits& earlier = w.earlier;
    if (!earlier.is_in_series()) return true;
    const FloatPlane grid = recentred(grid_from_image, {-from_centre.x, -from_centre.y});
    if (!earlier.is_joining) {
        earlier.note(block, grid, false);
        return true;
    }
    const auto joined = earlier.join(block, grid);
    if (joined) block = joined->block;
    return joined.has_value();
}

}  // namespace

void undistort(const FixedLens& lens, FloatVec middle, PatchDots& dots) {
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

bool place_patch(const ImageView& image, FixedVec around_px, int scale, DesktopWorkspace& w) {
    return place_patch(image, around_px.x, around_px.y, kPatchWidth_px * scale,
                       kPatchHeight_px * scale, scale, *w.patch);
}

bool find_patch_dots(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                     DesktopWorkspace& w) {
    Patch& patch = *w.patch;
    patch.dots.count = 0;
    kernels.fill_patch(image, patch);
    kernels.smooth_patch(patch);
    if (!measure_contrast(patch)) return false;
    kernels.find_minima(patch);
    w.fix.dots_seen = std::max(w.fix.dots_seen, patch.dots.count);
    const bool are_few = w.fix.dots_seen < std::max(min_dots(options, w), 1);
    w.fix.status = are_few ? Status::too_few_dots : Status::no_grid;
    return true;
}

bool read_grid(const Kernels& kernels, const DeviceOptions& options, const PatchGrid& grid,
               FloatVec from_centre, DesktopWorkspace& w, Hypothesis& hypothesis) {
    const Patch& patch = *w.patch;
    BitBlock block;
    kernels.read_cells(patch.dots, grid.grid_from_image, grid.displacement, block.columns,
                       block.rows);
    if (!join_earlier(grid.grid_from_image, from_centre, w, block)) return false;
    int quarters = 0;
    if (!find_turn_and_place(kernels, options, block, w, quarters, hypothesis.place)) return false;
    hypothesis.pattern_from_image = turned(quarters, grid.grid_from_image);
    hypothesis.from_centre = from_centre;
    hypothesis.displacement = grid.displacement;
    hypothesis.depth_q8 = patch.dot_contrast_q8;
    return true;
}

bool read_hypothesis(const Kernels& kernels, const DeviceOptions& options, const PatchView& view,
                     FloatVec from_centre, DesktopWorkspace& w, Hypothesis& hypothesis) {
    PatchGrid grid;
    return find_grid(kernels, *w.patch, view, grid) &&
           read_grid(kernels, options, grid, from_centre, w, hypothesis);
}

}  // namespace dotpose::core

#include "core/attempts/first.hpp"

#include <cmath>

#include "core/attempts/confirm.hpp"
#include "core/attempts/rows.hpp"
#include "core/attempts/steps.hpp"
#include "core/decode/bit_lines.hpp"
#include "core/detect/patch.hpp"
#include "core/lattice/outwards.hpp"

namespace dotpose::core {
namespace {

constexpr int kPatchWidth_px = 224;
constexpr int kPatchHeight_px = 160;

/// The dots where a camera without distortion would see them.
void straighten(const Lens& lens, FloatVec middle, PatchDots& dots) {
    const FloatLens l = float_lens(lens);
    for (std::size_t i = 0; i < static_cast<std::size_t>(dots.count); ++i) {
        const float x = dots.x[i] + middle.x - l.centre_x;
        const float y = dots.y[i] + middle.y - l.centre_y;
        const float by = 1 / (1 + l.k * (x * x + y * y));
        dots.x[i] = x * by + l.centre_x - middle.x;
        dots.y[i] = y * by + l.centre_y - middle.y;
    }
}

bool find_sight(const Kernels& kernels, const ImageView& image, const Options& options,
                Workspace& w, Sight& sight) {
    Patch& patch = *w.patch;
    kernels.fill_patch(image, patch);
    kernels.smooth_patch(patch);
    if (!measure_contrast(patch)) return false;
    kernels.find_minima(patch);
    const FloatVec middle{middle_u_px(patch) - static_cast<float>(image.width_px - 1) / 2,
                          middle_v_px(patch) - static_cast<float>(image.height_px - 1) / 2};
    if (options.lens.k_q40 != 0) straighten(options.lens, middle, patch.dots);
    PatchGrid grid;
    if (!find_grid(kernels, patch, grid)) return false;
    BitBlock block;
    kernels.read_cells(patch.dots, grid.grid_from_image, grid.displacement, block.columns,
                       block.rows);
    const int quarters = likeliest_turn(kernels, block);
    const BlockLines lines = score_block(kernels, turned(quarters, block), w.line_scores);
    if (!find_place(options.profile, lines, sight.place)) return false;
    sight.pattern_from_image =
        recentred(turned(quarters, grid.grid_from_image), {-middle.x, -middle.y});
    sight.displacement = grid.displacement;
    sight.depth_q8 = patch.depth_q8;
    return true;
}

}  // namespace

bool locate_outwards(const Kernels& kernels, const ImageView& image, const Options& options,
                     Workspace& w) {
    for (const int scale : {1, 2, 4}) {
        if (!place_patch(image, image.width_px / 2, image.height_px / 2, kPatchWidth_px * scale,
                         kPatchHeight_px * scale, scale, *w.patch)) {
            return false;
        }
        Sight sight;
        if (!find_sight(kernels, image, options, w, sight)) continue;
        const Confirmation confirmation = confirm(kernels, image, options, sight, w);
        w.fix.attempt = Attempt::first;
        if (confirmation != Confirmation::implausible) return confirmation == Confirmation::ok;
    }
    return false;
}

Fix make_first_attempt(const ImageView& image, const Options& options, Workspace& w) {
    forget_frame(w);
    const bool is_wanted = options.decoder == Decoder::all && w.patch != nullptr;
    if (is_wanted && locate_outwards(kernels(), image, options, w)) return w.fix;
    detect_image(image, options, w);
    return finish_rows(options, w);
}

}  // namespace dotpose::core

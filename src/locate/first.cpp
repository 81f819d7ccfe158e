#include "locate/first.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "core/decode/bit_lines.hpp"
#include "core/decode/exact_lines.hpp"
#include "core/detect/patch.hpp"
#include "core/integrity/known_places.hpp"
#include "core/lattice/outwards.hpp"
#include "core/steps.hpp"
#include "locate/confirm.hpp"
#include "locate/on_sheets.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::first;

constexpr int kPatchWidth_px = tuned::kPatchWidth_px;
constexpr int kPatchHeight_px = tuned::kPatchHeight_px;

/// Moves the dots to their undistorted image points.
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

/// Returns the middle of a patch, in px relative to the image centre.
FloatVec middle_of(const Patch& patch, const ImageView& image) {
    return {middle_u_px(patch) - static_cast<float>(image.width_px - 1) / 2,
            middle_v_px(patch) - static_cast<float>(image.height_px - 1) / 2};
}

/// Places a patch around a point of the image, in px. Returns false if the patch is too small for a
/// grid.
bool place_patch(const ImageView& image, FixedVec around_px, int scale, DesktopWorkspace& w) {
    return place_patch(image, around_px.x, around_px.y, kPatchWidth_px * scale,
                       kPatchHeight_px * scale, scale, *w.patch);
}

/// Finds the dots of the patch, and sets the status of the fix for the case that no patch contains
/// a grid. Returns false, without setting the status, if the patch has no contrast.
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
/// replaces the bits by those of all frames, and returns false if their grids do not match. The
/// plane is relative to `from_centre`.
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

/// Finds a place in the code from the dots of a patch. The dots and the hypothesis are relative to
/// `from_centre`. Returns false if no grid or no place is found.
bool read_hypothesis(const Kernels& kernels, const DeviceOptions& options, const PatchView& view,
                     FloatVec from_centre, DesktopWorkspace& w, Hypothesis& hypothesis) {
    Patch& patch = *w.patch;
    PatchGrid grid;
    if (!find_grid(kernels, patch, view, grid)) return false;
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

/// Sets `is_mirrored` of the workspace if the dots of a patch around the image centre show the
/// mirrored code. The code counts as mirrored only if adjacent lines have no wrong bits. Mirrors
/// the dots of the patch and does not restore them.
void find_mirror_image(const Kernels& kernels, const DeviceOptions& options, DesktopWorkspace& w) {
    if (w.is_mirrored) return;
    Patch& patch = *w.patch;
    for (std::size_t i = 0; i < static_cast<std::size_t>(patch.dots.count); ++i)
        patch.dots.x[i] = -patch.dots.x[i];
    PatchGrid grid;
    if (!find_grid(kernels, patch, whole_view(patch), grid)) return;
    BitBlock block;
    kernels.read_cells(patch.dots, grid.grid_from_image, grid.displacement, block.columns,
                       block.rows);
    Place place;
    w.is_mirrored =
        find_place_exactly(options.code, turned(likeliest_turn(kernels, block), block), place);
}

/// Returns true if the grid of the patch predicts all dots of the image to within a fraction of a
/// pixel. The patch must be the whole image, so the grid was fitted to all dots, and the spacing
/// must be at least kMinSpacingForPrediction_px.
bool predicts_dots(const ImageView& image, const Patch& patch, const FloatPlane& plane) {
    return patch.width_px == image.width_px && patch.height_px == image.height_px &&
           spacing_px(plane) >= tuned::kMinSpacingForPrediction_px;
}

/// Finds the grid of the dots of the patch at the image centre, and confirms its hypothesis. The
/// cells may be any parallelograms if `is_skewed` is true, and must be about square otherwise.
Confirmation locate_grid(const Kernels& kernels, const ImageView& image,
                         const DeviceOptions& options, bool is_skewed, DesktopWorkspace& w) {
    Patch& patch = *w.patch;
    PatchView view = whole_view(patch);
    view.min_dots = min_dots(options, w);
    view.is_skewed = is_skewed;
    const FloatVec middle = middle_of(patch, image);
    Hypothesis hypothesis;
    if (!read_hypothesis(kernels, options, view, middle, w, hypothesis))
        return Confirmation::implausible;
    hypothesis.pattern_from_image =
        recentred(hypothesis.pattern_from_image, {-middle.x, -middle.y});
    hypothesis.from_centre = {};
    hypothesis.is_predicted = predicts_dots(image, patch, hypothesis.pattern_from_image);
    return confirm(kernels, image, options, hypothesis, w);
}

/// Searches the patch at the image centre for a square grid. If this search yields no plausible
/// hypothesis, searches the patch for a grid of any parallelograms, because a rolling shutter
/// shears and stretches the image of a moving scene.
Confirmation locate_in_middle(const Kernels& kernels, const ImageView& image,
                              const DeviceOptions& options, DesktopWorkspace& w) {
    Patch& patch = *w.patch;
    if (!find_patch_dots(kernels, image, options, w)) return Confirmation::implausible;
    if (options.lens.k_q40 != 0) undistort(options.lens, middle_of(patch, image), patch.dots);
    const Confirmation square = locate_grid(kernels, image, options, false, w);
    return square == Confirmation::implausible ? locate_grid(kernels, image, options, true, w)
                                               : square;
}

/// Finds a hypothesis in a patch around a point of the image, in px. Sets `densest_px`, the origin
/// of the hypothesis, to the point where the dots are densest. Returns false if the patch yields no
/// hypothesis. Leaves `densest_px` unchanged if the patch is too small, or has no contrast or too
/// few dots.
bool find_hypothesis_around(const Kernels& kernels, const ImageView& image,
                            const DeviceOptions& options, FixedVec around_px, int scale,
                            DesktopWorkspace& w, FixedVec& densest_px, Hypothesis& hypothesis) {
    Patch& patch = *w.patch;
    PatchView view;
    FloatVec from_middle;
    if (!place_patch(image, around_px, scale, w) || !find_patch_dots(kernels, image, options, w)) {
        return false;
    }
    keep_isolated(patch);
    if (!move_origin_to_densest(patch, view, from_middle)) return false;
    densest_px = {static_cast<std::int32_t>(middle_u_px(patch) + from_middle.x),
                  static_cast<std::int32_t>(middle_v_px(patch) + from_middle.y)};
    const FloatVec middle = middle_of(patch, image);
    const FloatVec from_centre{middle.x + from_middle.x, middle.y + from_middle.y};
    if (options.lens.k_q40 != 0) undistort(options.lens, from_centre, patch.dots);
    hypothesis.is_partial_view = true;
    const auto spacings = w.known.any() ? std::span<const float>(tuned::kSpacingsOfKnown)
                                        : std::span<const float>(tuned::kSpacings);
    for (const float central_dots : tuned::kCentralDots) {
        for (const float by : spacings) {
            const PatchView other{by * view.spacing_px, view.full_reach_px, central_dots,
                                  min_dots(options, w)};
            if (read_hypothesis(kernels, options, other, from_centre, w, hypothesis)) return true;
        }
    }
    return false;
}

/// Searches a patch around a point of the image. If the patch yields no hypothesis and its dots are
/// densest far from its middle, also searches a patch around the densest point. `tries_left` is the
/// number of hypotheses that may still turn out to be uncertain before the search ends. Each
/// uncertain hypothesis increases the probability of a wrong fix.
Confirmation locate_around(const Kernels& kernels, const ImageView& image,
                           const DeviceOptions& options, FixedVec around_px, int scale,
                           int& tries_left, DesktopWorkspace& w) {
    for (int round = 0; round < 2 && tries_left > 0; ++round) {
        Hypothesis hypothesis;
        FixedVec densest_px = around_px;
        if (find_hypothesis_around(kernels, image, options, around_px, scale, w, densest_px,
                                   hypothesis)) {
            const auto confirmation = confirm(kernels, image, options, hypothesis, w);
            tries_left -= confirmation == Confirmation::implausible ? 0 : 1;
            return confirmation;
        }
        const bool is_other_patch =
            4 * std::abs(densest_px.x - around_px.x) > kPatchWidth_px * scale ||
            4 * std::abs(densest_px.y - around_px.y) > kPatchHeight_px * scale;
        if (!is_other_patch) break;
        around_px = densest_px;
    }
    return Confirmation::implausible;
}

/// Searches the whole image in adjacent patches. The size of the patches increases from round to
/// round.
Confirmation locate_elsewhere(const Kernels& kernels, const ImageView& image,
                              const DeviceOptions& options, DesktopWorkspace& w) {
    int tries_left = tuned::kMaxTries;
    for (const int scale : {1, 2, 4}) {
        const int width = kPatchWidth_px * scale;
        const int height = kPatchHeight_px * scale;
        for (int v = height / 2; v < image.height_px + height / 2; v += height) {
            for (int u = width / 2; u < image.width_px + width / 2; u += width) {
                const Confirmation confirmation =
                    locate_around(kernels, image, options, {u, v}, scale, tries_left, w);
                if (confirmation == Confirmation::ok) return confirmation;
            }
        }
    }
    return tries_left < tuned::kMaxTries ? Confirmation::uncertain : Confirmation::implausible;
}

/// Searches patches of increasing size around the image centre, and then patches all over the
/// image.
Confirmation locate_outwards(const Kernels& kernels, const ImageView& image,
                             const DeviceOptions& options, DesktopWorkspace& w) {
    for (const int scale : {1, 2, 4}) {
        if (!place_patch(image, {image.width_px / 2, image.height_px / 2}, scale, w)) break;
        const Confirmation confirmation = locate_in_middle(kernels, image, options, w);
        if (confirmation == Confirmation::ok) return confirmation;
        // Other patches of the same dots give the same bits.
        const bool is_whole_image =
            w.patch->width_px == image.width_px && w.patch->height_px == image.height_px;
        if (confirmation == Confirmation::too_few_bits && is_whole_image) return confirmation;
        find_mirror_image(kernels, options, w);
        if (confirmation != Confirmation::implausible) break;
    }
    return locate_elsewhere(kernels, image, options, w);
}

}  // namespace

bool locate_first(const Kernels& kernels, const ImageView& image, const DeviceOptions& options,
                  DesktopWorkspace& w) {
    forget_frame(w);
    w.fix.status = Status::no_contrast;
    w.shows_too_few_cells = false;
    Confirmation confirmation = locate_outwards(kernels, image, options, w);
    if (confirmation != Confirmation::ok && w.earlier.has_earlier()) {
        w.earlier.is_joining = true;
        const Confirmation together = locate_outwards(kernels, image, options, w);
        w.earlier.is_joining = false;
        if (together == Confirmation::ok) confirmation = together;
    }
    w.fix.attempt = Attempt::first;
    if (confirmation == Confirmation::uncertain || confirmation == Confirmation::too_few_bits)
        w.fix.status = w.shows_too_few_cells ? Status::grid_too_small : Status::not_certain;
    return confirmation == Confirmation::ok;
}

}  // namespace dotpose::core

#include "locate/first.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "core/decode/bit_lines.hpp"
#include "core/decode/exact_lines.hpp"
#include "core/detect/patch.hpp"
#include "core/lattice/outwards.hpp"
#include "core/steps.hpp"
#include "locate/confirm.hpp"
#include "locate/patch_hypothesis.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::first;

constexpr int kPatchWidth_px = tuned::kPatchWidth_px;
constexpr int kPatchHeight_px = tuned::kPatchHeight_px;

/// Sets `is_mirrored` of the workspace if the dots of a patch around the image centre show the
/// mirrored code. A grid counts as mirrored only if adjacent lines without wrong bits determine a
/// place (`find_place_exactly`). Leaves the dots of the patch mirrored.
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

/// Returns true if the grid of the patch predicts all dots in the image to within a fraction of a
/// pixel. The patch must cover the whole image, because otherwise its grid is not fitted to all
/// dots. The spacing must be at least kMinSpacingForPrediction_px.
bool predicts_dots(const ImageView& image, const Patch& patch, const FloatPlane& plane) {
    return patch.width_px == image.width_px && patch.height_px == image.height_px &&
           spacing_px(plane) >= tuned::kMinSpacingForPrediction_px;
}

/// Finds the grid in the patch at the image centre, and tests its hypothesis. If `is_skewed` is
/// true, cells may be arbitrary parallelograms. Otherwise, cells must be about square.
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

/// Searches the patch at the image centre for a square grid. If there is no plausible hypothesis,
/// also searches for a grid of arbitrary parallelograms, because a rolling shutter shears and
/// stretches moving scenes.
Confirmation locate_in_middle(const Kernels& kernels, const ImageView& image,
                              const DeviceOptions& options, DesktopWorkspace& w) {
    Patch& patch = *w.patch;
    if (!find_patch_dots(kernels, image, options, w)) return Confirmation::implausible;
    if (options.lens.k_q40 != 0) undistort(options.lens, middle_of(patch, image), patch.dots);
    const Confirmation square = locate_grid(kernels, image, options, false, w);
    return square == Confirmation::implausible ? locate_grid(kernels, image, options, true, w)
                                               : square;
}

/// Finds a hypothesis in a patch around an image point. Sets `densest_px` to the point where the
/// dots are densest, which is also the origin of the hypothesis. Returns false if there is no
/// hypothesis. Leaves `densest_px` unchanged if the patch is too small, has no contrast, or has too
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

/// Searches a patch around an image point. If there is no hypothesis and the dots are densest far
/// from the middle, also searches a patch around the densest point. `tries_left` is the number of
/// uncertain hypotheses that are still permitted. Each uncertain hypothesis increases the
/// probability of a wrong fix.
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

/// Searches the whole image in adjacent patches. The patches grow from round to round.
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

/// Searches patches of increasing size around the image centre. Then searches patches that cover
/// the whole image.
Confirmation locate_outwards(const Kernels& kernels, const ImageView& image,
                             const DeviceOptions& options, DesktopWorkspace& w) {
    for (const int scale : {1, 2, 4}) {
        if (!place_patch(image, {image.width_px / 2, image.height_px / 2}, scale, w)) break;
        const Confirmation confirmation = locate_in_middle(kernels, image, options, w);
        if (confirmation == Confirmation::ok) return confirmation;
        // If the patch covers the whole image, other patches contain the same dots and give the
        // same bits.
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
    w.has_clear_bits = confirmation == Confirmation::too_few_bits;
    if (confirmation == Confirmation::uncertain || confirmation == Confirmation::too_few_bits)
        w.fix.status = Status::not_certain;
    return confirmation == Confirmation::ok;
}

}  // namespace dotpose::core

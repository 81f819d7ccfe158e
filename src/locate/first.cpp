#include "locate/first.hpp"

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
#include "locate/trace.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::first;

constexpr int kPatchWidth_px = tuned::kPatchWidth_px;
constexpr int kPatchHeight_px = tuned::kPatchHeight_px;

/// Returns true if the dots of a patch around the image centre show the mirrored code. A grid is
/// considered mirrored only if adjacent lines without wrong bits determine a place
/// (`find_place_exactly`). Negates the x coordinates of the dots in the patch.
bool shows_mirror_image(const Kernels& kernels, CodeVariant code, Patch& patch) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(patch.dots.count); ++i)
        patch.dots.x[i] = -patch.dots.x[i];
    PatchGrid grid;
    if (!find_grid(kernels, patch, whole_view(patch), grid)) return false;
    BitBlock block;
    kernels.read_cells(patch.dots, grid.grid_from_image, grid.displacement, block.columns,
                       block.rows);
    Place place;
    return find_place_exactly(code, turned(likeliest_turn(kernels, block), block), place);
}

bool is_whole_image(const Patch& patch, const ImageView& image) {
    return patch.width_px == image.width_px && patch.height_px == image.height_px;
}

/// Searches patches of the image for a grid, and tests the hypotheses that are decoded from the
/// bits of these grids.
class PatchSearch {
  public:
    PatchSearch(const Frame& frame, const PlaceEvidence& evidence, Patch& patch,
                Measurement& measurement, Fix& fix)
        : frame_(frame), evidence_(evidence), patch_(patch), measurement_(measurement), fix_(fix) {}

    /// Searches patches of increasing size around the image centre, then adjacent patches that
    /// together cover the whole image. Sets `is_mirrored` if a patch around the image centre shows
    /// the mirrored code.
    Confirmation search(bool& is_mirrored) {
        tries_left_ = tuned::kMaxTries;
        for (const int scale : {1, 2, 4}) {
            if (!place_patch_in_middle(frame_.image, scale, patch_)) break;
            const Confirmation confirmation = search_middle();
            if (ends(confirmation)) return confirmation;
            // If the patch covers the whole image, other patches contain no additional dots. In
            // small images, they rarely show another place either.
            if (is_whole_image(patch_, frame_.image) &&
                (confirmation == Confirmation::too_few_bits ||
                 (confirmation == Confirmation::uncertain && is_small(frame_.image))))
                return confirmation;
            is_mirrored =
                is_mirrored || shows_mirror_image(frame_.kernels, frame_.options.code, patch_);
            if (measurement_.shows_too_few_cells)
                return shows_too_few_dots() ? Confirmation::implausible
                                            : Confirmation::too_few_bits;
            if (confirmation != Confirmation::implausible) break;
        }
        return search_everywhere();
    }

    /// Returns true if a hypothesis with this result ends the search.
    static bool ends(Confirmation result) {
        return result == Confirmation::ok || result == Confirmation::rough;
    }

  private:
    /// Searches the patch at the image centre for a square grid, and tests its hypothesis. Also
    /// searches for a skewed grid, whose cells are arbitrary parallelograms, if there is no
    /// plausible hypothesis, or if the square grid is probably false and its hypothesis is
    /// uncertain. Grids are skewed if a rolling shutter reads the image of a moving scene.
    Confirmation search_middle() {
        if (!find_patch_dots(frame_, patch_, fix_)) return Confirmation::implausible;
        measurement_.shows_too_few_cells = shows_too_few_dots();
        if (measurement_.shows_too_few_cells) return Confirmation::implausible;
        undistort(frame_.options.lens, middle_of(patch_, frame_.image), patch_.dots);
        PatchGrid grid;
        Confirmation square = Confirmation::implausible;
        if (find_middle_grid(false, grid)) {
            // This test applies only to square grids. The spacing of a skewed grid is not reliable,
            // because scattered dots may form a skewed grid with any spacing.
            measurement_.shows_too_few_cells = shows_too_few_cells(grid.grid_from_image);
            if (measurement_.shows_too_few_cells) return Confirmation::implausible;
            square = test_grid(grid);
        }
        const bool is_false = square == Confirmation::uncertain && is_probably_false(grid);
        if (square != Confirmation::implausible && !is_false) return square;
        if (!find_middle_grid(true, grid)) return square;
        if (is_false) --tries_left_;
        const Confirmation skewed = test_grid(grid);
        return skewed == Confirmation::implausible ? square : skewed;
    }

    static bool is_probably_false(const PatchGrid& grid) {
        return grid.variance > tuning::patch_grid::kMaxVariance;
    }

    /// Finds the grid in the patch at the image centre. If `is_skewed` is true, cells may be
    /// arbitrary parallelograms. Otherwise, cells must be approximately square. If a search for a
    /// skewed grid finds no grid, or a grid that is probably false, the search is repeated with
    /// waves computed from fewer central dots, because a rotation displaces the outer dots.
    bool find_middle_grid(bool is_skewed, PatchGrid& grid) const {
        PatchView view = whole_view(patch_);
        view.min_dots = frame_.min_dots;
        view.is_skewed = is_skewed;
        const bool is_found = find_grid(frame_.kernels, patch_, view, grid);
        if (!is_skewed || (is_found && !is_probably_false(grid))) return is_found;
        view.central_dots = tuned::kFewerCentralDots;
        PatchGrid other;
        if (!find_grid(frame_.kernels, patch_, view, other)) return is_found;
        if (!is_found || other.agreement > grid.agreement) grid = other;
        return true;
    }

    /// Tests the hypothesis that is decoded from a grid in the patch at the image centre.
    Confirmation test_grid(const PatchGrid& grid) {
        auto hypothesis = read_grid(patch_, grid, middle_of(patch_, frame_.image), evidence_,
                                    PlaceSearch::thorough);
        if (!hypothesis) return Confirmation::implausible;
        move_origin_to_centre(*hypothesis);
        // If the patch is the whole image, the grid is fitted to all dots. It then predicts the
        // position of each dot to within a fraction of a pixel, unless the spacing is too small.
        hypothesis->is_predicted =
            is_whole_image(patch_, frame_.image) &&
            spacing_px(hypothesis->pattern_from_image) >= tuned::kMinSpacingForPrediction_px;
        return confirm(frame_, *hypothesis, evidence_, measurement_, fix_);
    }

    /// Returns true if the patch covers the whole of a small image, and contains too few dots for a
    /// reliable position, even if filtering the image reveals more dots. Returns false if the patch
    /// contains less than half of `Frame::min_dots` dots. Also returns false if the frame is part
    /// of a series, because the bits of earlier frames may make the position certain.
    bool shows_too_few_dots() const {
        const int dots = patch_.dots.count;
        return 2 * dots >= frame_.min_dots && is_whole_image(patch_, frame_.image) &&
               is_small(frame_.image) && !evidence_.earlier.is_in_series() &&
               are_too_few_cells(frame_, static_cast<int>(tuned::kDotsOfFilteredImage *
                                                          static_cast<float>(dots)));
    }

    /// Returns true if the patch is the whole image, and a grid with the spacing of the given grid
    /// has too few cells in this image for a reliable position. Returns false if the frame is part
    /// of a series, because the bits of earlier frames may make the position certain.
    bool shows_too_few_cells(const FloatPlane& grid_from_image) const {
        if (!is_whole_image(patch_, frame_.image) || evidence_.earlier.is_in_series()) return false;
        const float border = 2 * tuning::confirm::kBeyondBorder;
        const float spacing = spacing_px(grid_from_image);
        const float cells = (static_cast<float>(frame_.image.width_px) / spacing + border) *
                            (static_cast<float>(frame_.image.height_px) / spacing + border);
        return are_too_few_cells(frame_, static_cast<int>(std::min(cells, 1e6F)));
    }

    /// Searches the whole image. If the search fails, repeats it with thresholds for pale dots
    /// among graphics.
    Confirmation search_everywhere() {
        const int tries = tries_left_;
        for (const DotTiles tiles : {DotTiles::median, DotTiles::pale}) {
            dot_tiles_ = tiles;
            const Confirmation confirmation = search_patches();
            if (ends(confirmation)) return confirmation;
        }
        return tries_left_ < tries ? Confirmation::uncertain : Confirmation::implausible;
    }

    /// Searches adjacent patches that cover the image. The patch size doubles from round to round.
    /// Returns the result of the last patch that was searched.
    Confirmation search_patches() {
        const ImageView& image = frame_.image;
        Confirmation last = Confirmation::implausible;
        for (const int scale : {1, 2, 4}) {
            const int width = kPatchWidth_px * scale;
            const int height = kPatchHeight_px * scale;
            for (int v = height / 2; v < image.height_px + height / 2; v += height) {
                for (int u = width / 2; u < image.width_px + width / 2; u += width) {
                    last = search_around({u, v}, scale);
                    if (ends(last)) return last;
                }
            }
        }
        return last;
    }

    /// Searches a patch around an image point. If there is no hypothesis and the dots are densest
    /// far from the middle of the patch, also searches a patch around the densest point.
    Confirmation search_around(FixedVec around_px, int scale) {
        for (int round = 0; round < 2 && tries_left_ > 0; ++round) {
            FixedVec densest_px = around_px;
            if (const auto hypothesis = find_hypothesis(around_px, scale, densest_px)) {
                const auto confirmation =
                    confirm(frame_, *hypothesis, evidence_, measurement_, fix_);
                tries_left_ -= confirmation == Confirmation::implausible ? 0 : 1;
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

    /// Finds a hypothesis in a patch around an image point. Sets `densest_px` to the point where
    /// the dots are densest, which is also the origin of the hypothesis. Returns nullopt if there
    /// is no hypothesis. Leaves `densest_px` unchanged if the patch is too small, has no contrast,
    /// or has too few dots.
    std::optional<Hypothesis> find_hypothesis(FixedVec around_px, int scale, FixedVec& densest_px) {
        PatchView view;
        FloatVec from_middle;
        if (!place_patch(frame_.image, around_px, scale, patch_) ||
            !find_patch_dots(frame_, patch_, fix_, dot_tiles_))
            return {};
        keep_isolated(patch_);
        if (!move_origin_to_densest(patch_, view, from_middle)) return {};
        densest_px = {static_cast<std::int32_t>(middle_u_px(patch_) + from_middle.x),
                      static_cast<std::int32_t>(middle_v_px(patch_) + from_middle.y)};
        const FloatVec middle = middle_of(patch_, frame_.image);
        const FloatVec from_centre{middle.x + from_middle.x, middle.y + from_middle.y};
        undistort(frame_.options.lens, from_centre, patch_.dots);
        const auto spacings = frame_.known.any() ? std::span<const float>(tuned::kSpacingsOfKnown)
                                                 : std::span<const float>(tuned::kSpacings);
        for (const float central_dots : tuned::kCentralDots) {
            for (const float by : spacings) {
                const PatchView other{by * view.spacing_px, view.full_reach_px, central_dots,
                                      frame_.min_dots};
                auto hypothesis = read_hypothesis(patch_, other, from_centre, evidence_);
                if (!hypothesis) continue;
                hypothesis->is_partial_view = true;
                return hypothesis;
            }
        }
        return {};
    }

    const Frame& frame_;
    const PlaceEvidence& evidence_;
    Patch& patch_;
    Measurement& measurement_;
    Fix& fix_;
    /// Number of uncertain hypotheses that the search may still test. The number is limited,
    /// because each further hypothesis may agree with the bits by chance, and thus increases the
    /// probability of a wrong fix.
    int tries_left_ = 0;
    DotTiles dot_tiles_ = DotTiles::median;  ///< tiles used by `find_hypothesis`
};

}  // namespace

bool locate_first(const Frame& frame, DesktopWorkspace& w) {
    forget_frame(w);
    w.fix.status = Status::no_contrast;
    w.measurement.shows_too_few_cells = false;
    w.measurement.is_still = false;
    const PlaceEvidence evidence = w.evidence(frame);
    PatchSearch patches(frame, evidence, *w.patch, w.measurement, w.fix);
    Confirmation confirmation = patches.search(w.is_mirrored);
    if (!PatchSearch::ends(confirmation) && w.earlier.has_earlier()) {
        w.earlier.is_joining = true;
        const Confirmation together = patches.search(w.is_mirrored);
        w.earlier.is_joining = false;
        if (together == Confirmation::ok) confirmation = together;
    }
    w.fix.attempt = Attempt::first;
    const bool may_be_still = confirmation == Confirmation::uncertain && w.measurement.is_still;
    w.measurement.is_still = confirmation == Confirmation::too_few_bits || may_be_still;
    w.measurement.is_rough = confirmation == Confirmation::rough;
    if (confirmation == Confirmation::ok) {
        store_for_trace(w.measurement, frame.options.show_stages, w);
        return true;
    }
    if (confirmation != Confirmation::implausible) w.fix.status = Status::not_certain;
    return false;
}

}  // namespace dotpose::core

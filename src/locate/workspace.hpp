// Desktop workspace: all memory that a Locator uses.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/detect/smooth.hpp"
#include "core/other_codes.hpp"
#include "core/patch_memory.hpp"
#include "core/workspace.hpp"
#include "device/workspace.hpp"
#include "dotpose/image.hpp"
#include "locate/confirm.hpp"
#include "locate/earlier_bits.hpp"
#include "locate/frame.hpp"
#include "locate/place_evidence.hpp"
#include "locate/pushed_image.hpp"

namespace dotpose::core {

/// Memory of a Locator, and results of its attempts. Only the entry points and the attempts access
/// the whole workspace. They pass parts of it to the stages. The base class is the memory of a
/// DeviceLocator. Attempts with `Effort::device` also use it.
struct DesktopWorkspace : DeviceWorkspace {
    Patch* patch = nullptr;   ///< used by the first attempt and the search for a rotation
    Smoothing smoothing;      ///< used by the second attempt
    Measurement measurement;  ///< memory and results of `confirm`
    OtherCodes other_codes;   ///< odds of the codes other than the one that was read
    EarlierBits earlier;
    WorkLimit work{WorkLimit::kOfImage};  ///< see `PlaceEvidence::work`
    PushedImage pushed;
    std::span<std::uint8_t> rolling_pixels;  ///< memory for the derotated image
    bool is_mirrored = false;                ///< true if an attempt found the mirrored code
    ComparedBits compared_bits;              ///< see `Locator::compared_bits`

    /// Sets the known sheets. On known sheets, smaller images and patches can be located.
    void set_known(const KnownSheets& sheets) {
        DeviceWorkspace::set_known(sheets);
        patch->min_side_px = sheets.any() ? kMinKnownFrameSide_px : Patch::kMinSide_px;
    }

    /// Returns the input of an attempt. If sheets are known or frames are read together, the
    /// attempt needs fewer dots, because a place can be certain with fewer bits.
    Frame frame(const Kernels& kernels, const ImageView& image,
                const DeviceOptions& options) const {
        const bool need_few = known.any() || earlier.is_in_series();
        return {kernels, image, options, known,
                need_few ? std::min(options.lattice.min_dots, kMinKnownDots)
                         : options.lattice.min_dots};
    }

    /// Returns the sources of evidence that an attempt uses to find and test places.
    PlaceEvidence evidence(const Frame& frame) {
        return {frame.kernels, frame.options, known,
                earlier,       line_scores,   other_codes.are_wanted ? &other_codes : nullptr,
                work};
    }
};

/// A workspace with its memory, for images up to `MaxWidth` px wide. Stores at most the `MaxDots`
/// dots nearest to the image centre, and the middle `GridSide` x `GridSide` cells of the grid.
template <int MaxWidth, int MaxDots, int GridSide>
class WorkspaceOf : public DesktopWorkspace {
  public:
    static_assert(MaxWidth >= 64 && MaxWidth <= 4096, "images are 64 to 4096 px wide");
    static_assert(GridSide >= 16 && GridSide <= kMaxGridSide,
                  "the grid has 16 to kMaxGridSide cells per axis");
    static_assert(MaxDots >= 64 && MaxDots < GridCell::kHidden, "indices of dots have 16 bits");

    WorkspaceOf() {
        max_width_px = MaxWidth;
        keeps_every_stage = true;
        in_whole_code = &kWholeCodeFunctions;
        pushed.memory = pushed_;
        rolling_pixels = rolling_;
        patch = &patch_;
        auto& [cells_x, cells_y, x, y] = floats_;
        auto& [bits, window_u, window_v, mass, sum_u, sum_v, paper] = ints_;
        measurement.dots = {0,    cells_x, cells_y, bits,  window_u, window_v,
                            mass, sum_u,   sum_v,   paper, x,        y};
        measurement.rolls = {rolls_[0], rolls_[1]};
        smoothing.lines = smooth_lines_;
        smoothing.row = smooth_row_;
        smoothing.paper.levels = papers_;
        smoothing.paper.brightest = brightest_papers_;
        smoothing.column_sums = smooth_sums_;
        threshold.rows = rows_;
        threshold.tiles = tiles_;
        threshold.half_low_levels = half_low_levels_;
        threshold.high_levels = high_levels_;
        open.runs = runs_;
        open.blobs = blobs_;
        dots = dots_;
        seeds = seeds_;
        buckets = buckets_;
        edge_values = edge_values_;
        neighbours = neighbours_;
        edges = edges_;
        grid.storage = cells_;
        grid.side = GridSide;
        line_scores = line_scores_;
        tracking.rows = tracked_rows_;
        tracking.lines = tracked_lines_;
        tracking.grid_rows = grid_rows_;
        tracking.found = dots_;
    }
    WorkspaceOf(const WorkspaceOf&) = delete;
    WorkspaceOf& operator=(const WorkspaceOf&) = delete;

  private:
    // Maximum height of a threshold tile in this workspace. Tall tiles, which need more memory, are
    // used only for images whose shorter side exceeds kMaxSideWithLowTiles_px. See
    // `begin_threshold`.
    static constexpr int kBand_px =
        MaxWidth <= kMaxSideWithLowTiles_px ? kLowTile_px : kHighTile_px;
    static constexpr int kTiles = MaxWidth / kTileWidth_px + 1;
    static constexpr int kLevels = kTiles * kTileWidth_px + kReadAhead_px;
    // Maximum number of blocks in a PaperMap. The side of a block is a tenth of the shorter image
    // side, rounded down. The shorter side is at least kMinFrameSide_px, so there are at most 12
    // blocks along it, and a block along the longer side is at least a tenth of kMinFrameSide_px.
    // The longer side may be the height, which `MaxWidth` does not limit.
    static constexpr std::size_t kPaperBlocks =
        12 * (kMaxFrameSide_px / (kMinFrameSide_px / 10) + 1);
    // Maximum number of runs in a row. A run may begin at every second pixel, and each run may
    // start a blob.
    static constexpr int kRuns = MaxWidth / 2 + 2;

    // Maximum number of pixels in an image that is pushed row by row: a square with sides of
    // `MaxWidth`, for example 188 x 188 px for the paper's sensor, but at most 1280 x 1024 px.
    static constexpr std::size_t kPushed_px = std::min(MaxWidth * MaxWidth, 1280 * 1024);

    // Maximum number of columns and maximum number of rows read in one view.
    static constexpr std::size_t kRolls = 1024;

    Patch patch_;
    std::array<std::array<float, MaxDots + 40>, 4> floats_;
    std::array<std::array<std::int32_t, MaxDots + 40>, 7> ints_;
    std::array<std::array<std::uint8_t, kRolls>, 2> rolls_;
    std::array<std::uint16_t, 5 * MaxWidth> smooth_lines_{};
    std::array<std::uint8_t, MaxWidth> smooth_row_{};
    std::array<std::uint8_t, kPaperBlocks> papers_{};
    std::array<std::uint8_t, kPaperBlocks> brightest_papers_{};
    std::array<std::uint32_t, MaxWidth> smooth_sums_{};
    alignas(
        8) std::array<std::uint8_t, 2 * kBand_px * kTiles * kTileWidth_px + kReadAhead_px> rows_{};
    std::array<Tile, 4 * kTiles> tiles_{};
    alignas(8) std::array<std::uint8_t, kLevels> half_low_levels_{};
    alignas(8) std::array<std::uint8_t, kLevels> high_levels_{};
    std::array<Run, 2 * kRuns> runs_{};
    std::array<OpenBlob, 2 * kRuns> blobs_{};
    std::array<DetectedDot, MaxDots> dots_{};
    std::array<std::uint16_t, kMaxSeeds> seeds_{};
    std::array<BucketedSeed, kMaxSeeds + 1> buckets_{};
    std::array<std::array<std::int16_t, 4>, kMaxSeeds> neighbours_{};
    std::array<SeedEdge, 2 * kMaxSeeds> edges_{};
    std::array<std::int32_t, 4 * kMaxSeeds> edge_values_{};
    std::array<GridCell, GridSide * GridSide> cells_{};
    std::array<ScoredLine, 2 * std::min(GridSide, kMaxLines)> line_scores_{};
    std::array<std::uint8_t, 36 * std::min(MaxWidth, 376)> tracked_rows_{};
    std::array<ComparedLine, 2 * kMaxComparedLines> tracked_lines_{};
    std::array<TrackedRow, kMaxComparedLines> grid_rows_{};
    std::array<std::uint8_t, kPushed_px> pushed_;
    std::array<std::uint8_t, kPushed_px> rolling_;
};

/// Workspace for the paper's sensor, with 188 x 120 px.
using SmallWorkspace = WorkspaceOf<188, 384, 32>;
/// Workspace for images up to 4096 x 4096 px.
using LargeWorkspace = WorkspaceOf<4096, 16384, 192>;

}  // namespace dotpose::core

// Desktop workspace: all memory of a Locator.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/detect/smooth.hpp"
#include "core/math/readout_turn.hpp"
#include "core/other_codes.hpp"
#include "core/patch_memory.hpp"
#include "core/pose/turn_fit.hpp"
#include "core/workspace.hpp"
#include "device/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/prediction.hpp"
#include "locate/earlier_bits.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {

/// An image that is pushed to a Locator row by row.
struct PushedImage {
    std::span<std::uint8_t> memory;
    int width_px = 0;
    int height_px = 0;
    int rows = 0;  ///< number of rows pushed so far
    bool has_prediction = false;
    Prediction prediction;

    /// Starts an image. Returns false if the image does not fit in the memory.
    bool begin(int width, int height) {
        width_px = width;
        height_px = height;
        rows = 0;
        has_prediction = false;
        return size(height) <= memory.size();
    }
    void add_row(const std::uint8_t* pixels) {
        std::copy_n(pixels, width_px, memory.begin() + static_cast<std::ptrdiff_t>(size(rows)));
        ++rows;
    }
    /// Returns the image. Missing rows are white.
    ImageView completed() const {
        const std::size_t begin = size(rows);
        std::fill_n(memory.begin() + static_cast<std::ptrdiff_t>(begin), size(height_px) - begin,
                    std::uint8_t{255});
        return {memory.data(), width_px, height_px, width_px};
    }

  private:
    std::size_t size(int height) const {
        return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height);
    }
};

/// An image of a rolling shutter after removing the rotation of the scene, and the fit of this
/// rotation.
struct RollingImage {
    std::span<std::uint8_t> memory;
    bool is_fitted = false;  ///< true if `confirm` fits the rotation
    ReadoutTurn turn;        ///< rotation that was removed from the image
    TurnFit fit;             ///< fitted by the last `confirm`, if `is_fitted` is true
};

/// Memory of a Locator: the memory of a DeviceLocator, and the memory that only a Locator needs.
struct DesktopWorkspace : DeviceWorkspace {
    Patch* patch = nullptr;
    MeasuredDots measured;
    std::span<std::uint8_t> column_rolls;
    std::span<std::uint8_t> row_rolls;
    Smoothing smoothing;
    OtherCodes other_codes;
    EarlierBits earlier;
    PushedImage pushed;
    RollingImage rolling;
    bool is_mirrored = false;  ///< true if an attempt found the mirrored code
    /// True if the first attempt found fewer cells than a certain position needs without known
    /// sheets.
    bool shows_too_few_cells = false;
    /// True if all dots that the first attempt measured are clear and agree with the code, but are
    /// too few. A rotation during the readout would misplace some of them.
    bool has_clear_bits = false;

    /// Sets the known sheets. On known sheets, smaller images and patches can be located.
    void set_known(const KnownSheets& sheets) {
        DeviceWorkspace::set_known(sheets);
        patch->min_side_px = sheets.any() ? kMinKnownFrameSide_px : Patch::kMinSide_px;
    }
};

/// Returns the minimum number of dots in a grid. Known sheets and frames that are read together
/// need fewer dots.
inline int min_dots(const DeviceOptions& options, const DesktopWorkspace& w) {
    return w.known.any() || w.earlier.is_in_series()
               ? std::min(options.lattice.min_dots, kMinKnownDots)
               : options.lattice.min_dots;
}

/// Returns the storage for the odds of other codes, or null if the odds are not requested.
inline OtherCodes* wanted_codes(DesktopWorkspace& w) {
    return w.other_codes.are_wanted ? &w.other_codes : nullptr;
}

/// A workspace with its memory, for images up to `MaxWidth` px wide. Stores at most `MaxDots` dots,
/// those nearest to the image centre, and the middle `GridSide` x `GridSide` cells of the grid.
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
        pushed.memory = pushed_;
        rolling.memory = rolling_;
        patch = &patch_;
        measured.column = floats_[0];
        measured.row = floats_[1];
        measured.x = floats_[2];
        measured.y = floats_[3];
        measured.bits = ints_[0];
        measured.window_u = ints_[1];
        measured.window_v = ints_[2];
        measured.mass = ints_[3];
        measured.sum_u = ints_[4];
        measured.sum_v = ints_[5];
        measured.paper = ints_[6];
        column_rolls = rolls_[0];
        row_rolls = rolls_[1];
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
    }
    WorkspaceOf(const WorkspaceOf&) = delete;
    WorkspaceOf& operator=(const WorkspaceOf&) = delete;

  private:
    // Images have low tiles if their shorter side is at most kMaxSideWithLowTiles_px. Other images
    // have high tiles, which need more memory. See `begin_threshold`.
    static constexpr int kBand_px =
        MaxWidth <= kMaxSideWithLowTiles_px ? kLowTile_px : kHighTile_px;
    static constexpr int kTiles = MaxWidth / kTileWidth_px + 1;
    static constexpr int kLevels = kTiles * kTileWidth_px + kReadAhead_px;
    // Maximum number of runs in a row. A run may begin at every second pixel, and each run may
    // begin a blob.
    static constexpr int kRuns = MaxWidth / 2 + 2;

    // Size of the largest image that can be pushed row by row: 188 x 188 px for the paper's sensor,
    // and 1280 x 1024 px otherwise.
    static constexpr std::size_t kPushed_px = std::min(MaxWidth * MaxWidth, 1280 * 1024);

    // Maximum number of lines that cross an image at any angle.
    static constexpr std::size_t kRolls = 1024;

    Patch patch_;
    std::array<std::array<float, MaxDots + 40>, 4> floats_;
    std::array<std::array<std::int32_t, MaxDots + 40>, 7> ints_;
    std::array<std::array<std::uint8_t, kRolls>, 2> rolls_;
    std::array<std::uint16_t, 5 * MaxWidth> smooth_lines_{};
    std::array<std::uint8_t, MaxWidth> smooth_row_{};
    // The side of a paper map block is a tenth of the shorter image side, and at least 6 px. There
    // are at most 11 x 683 blocks.
    std::array<std::uint8_t, 11 * 683> papers_{};
    std::array<std::uint8_t, 11 * 683> brightest_papers_{};
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

// Workspace: all memory of a Locator and, after a frame, the output of every stage. Capacities are
// fixed. It lies in the caller's DeviceMemory, SmallMemory or LargeMemory (src/core/locate.cpp) and
// is reused from frame to frame.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/other_codes.hpp"
#include "core/patch_memory.hpp"
#include "core/stages.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {

/// The memory and results of all stages, as spans. Use one of the aliases below.
struct Workspace {
    std::int16_t max_width_px = 0;
    std::int16_t max_height_px = kMaxFrameSide_px;
    // Attempts of desktops only; devices have no room for these.
    Patch* patch = nullptr;
    MeasuredDots measured;
    std::span<std::uint8_t> column_rolls;
    std::span<std::uint8_t> row_rolls;
    OtherCodes* other_codes = nullptr;
    bool has_second_attempt = false;  ///< whether it has the memory for the second attempt
    bool keeps_every_stage = false;  ///< whether each stage has its own memory, so that all of them
                                     ///< can be shown
    bool is_mirrored = false;        ///< whether an attempt saw the code as in a mirror
    // detect
    Smoothing smoothing;
    Tracking tracking;
    Light light;
    OpenBlobs open;
    std::span<Dot> dots;  ///< size is the capacity
    int dot_count = 0;
    int dots_kept_within_px = 0;  ///< distance from the image centre, per axis; shrinks when `dots`
                                  ///< is full
    // lattice
    std::span<std::uint16_t> seeds;  ///< indices of dots
    int seed_count = 0;
    std::span<BucketedSeed> buckets;                    ///< one more than there are seeds
    std::span<std::array<std::int16_t, 4>> neighbours;  ///< the four nearest of each seed
    std::span<Edge> edges;                              ///< two for each seed
    int edge_count = 0;
    std::span<std::int32_t> edge_values;  ///< two for each edge
    Lattice lattice;
    PlaneFromImage grid_from_image;
    // decode
    Grid grid;
    std::span<ScoredLine> line_scores;  ///< the columns, then in the second half the rows
    Decoding decoding;
    // pose
    PlaneFromImage pattern_from_image;  ///< in spacings from `Decoding::place`
    Fix fix;

    std::span<const Dot> found_dots() const {
        return dots.first(static_cast<std::size_t>(dot_count));
    }
};

/// A workspace with its memory, for images up to `MaxWidth` px wide. It keeps the `MaxDots` dots
/// nearest the image centre and the middle `GridSide` x `GridSide` cells of the grid.
template <int MaxWidth, int MaxDots, int GridSide>
class WorkspaceOf : public Workspace {
  public:
    static_assert(MaxWidth >= 64 && MaxWidth <= 4096, "images are 64 to 4096 px wide");
    static_assert(GridSide >= 16 && GridSide <= kMaxGridSide, "lines of the grid have fixed room");
    static_assert(MaxDots >= 64 && MaxDots < GridCell::kHidden, "dots are counted in 16 bits");

    WorkspaceOf() {
        max_width_px = MaxWidth;
        has_second_attempt = keeps_every_stage = true;
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
        other_codes = &other_codes_;
        smoothing.lines = smooth_lines_;
        smoothing.row = smooth_row_;
        smoothing.paper.levels = papers_;
        smoothing.paper.brightest = brightest_papers_;
        smoothing.column_sums = smooth_sums_;
        light.rows = rows_;
        light.tiles = tiles_;
        light.half_low_levels = half_low_levels_;
        light.high_levels = high_levels_;
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
    // Small images have low tiles, larger ones high tiles: see `begin_light`.
    static constexpr int kBand_px =
        MaxWidth <= kLargestWithLowTiles_px ? kLowTile_px : kHighTile_px;
    static constexpr int kTiles = MaxWidth / kTileWidth_px + 1;
    static constexpr int kLevels = kTiles * kTileWidth_px + kReadAhead_px;
    // Every second pixel may begin a run, and every run a blob.
    static constexpr int kRuns = MaxWidth / 2 + 2;

    // Number of lines that cross an image turned by any angle.
    static constexpr std::size_t kRolls = 1024;

    Patch patch_;
    std::array<std::array<float, MaxDots + 40>, 4> floats_;
    std::array<std::array<std::int32_t, MaxDots + 40>, 7> ints_;
    std::array<std::array<std::uint8_t, kRolls>, 2> rolls_;
    OtherCodes other_codes_;
    std::array<std::uint16_t, 5 * MaxWidth> smooth_lines_{};
    std::array<std::uint8_t, MaxWidth> smooth_row_{};
    // Blocks are a tenth of the shorter side, so at least 6 px: at most 11 x 683 of them.
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
    std::array<Dot, MaxDots> dots_{};
    std::array<std::uint16_t, kMaxSeeds> seeds_{};
    std::array<BucketedSeed, kMaxSeeds + 1> buckets_{};
    std::array<std::array<std::int16_t, 4>, kMaxSeeds> neighbours_{};
    std::array<Edge, 2 * kMaxSeeds> edges_{};
    std::array<std::int32_t, 4 * kMaxSeeds> edge_values_{};
    std::array<GridCell, GridSide * GridSide> cells_{};
    std::array<ScoredLine, 2 * std::min(GridSide, kMaxLines)> line_scores_{};
    std::array<std::uint8_t, 36 * std::min(MaxWidth, 376)> tracked_rows_{};
    std::array<TrackedLine, 2 * kMostTracked> tracked_lines_{};
    std::array<TrackedRow, kMostTracked> grid_rows_{};
};

/// Workspace for the paper's 188 x 120 px sensor.
using SmallWorkspace = WorkspaceOf<188, 384, 32>;
/// Workspace for images up to 4096 x 4096 px.
using LargeWorkspace = WorkspaceOf<4096, 16384, 192>;

}  // namespace dotpose::core

/// Stages: what each stage of `locate` keeps and leaves to the next one.
///
/// Fixed point: a suffix _qN marks a value in units of 2^-N. Pixel frame: the centre of the first
/// pixel is (0, 0), u to the right, v down.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/code.hpp"
#include "dotpose/status.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Width of the tiles in which light is measured; their height, for images whose shorter side is at
/// most `kLargestWithLowTiles_px`, and for larger ones. Three tiles must reach over a dot: an image
/// that shows 8 dots along its shorter side has a spacing of at most 1/8 of it, and dots a third of
/// that.
inline constexpr int kTileWidth_px = 16;
inline constexpr int kLowTile_px = 8;
inline constexpr int kHighTile_px = 16;
inline constexpr int kLargestWithLowTiles_px = 240;
/// Bytes after the last row and the last level that may be read, and do not count.
inline constexpr int kReadAhead_px = 8;
/// Half an extent by which every pixel is dark: who looks for dark pixels stops after the last one.
inline constexpr std::uint8_t kAlwaysDark = 128;
/// Dots nearest the image centre that give the first estimate of the grid.
inline constexpr int kMaxSeeds = 256;
/// Side of the decoding window of the paper (section II-B.5).
inline constexpr int kWindowSide = 8;

/// Most cells per axis of any workspace's grid.
inline constexpr int kMaxGridSide = 256;
/// Most columns and rows that are decoded: where more are in view, those read most clearly.
inline constexpr int kMaxLines = 64;

/// A vector or point in fixed point.
struct Vec {
    std::int32_t x = 0;
    std::int32_t y = 0;
    friend constexpr bool operator==(const Vec&, const Vec&) = default;
};

/// A detected dot.
struct Dot {
    Vec centre_q8;           ///< px; after `undistort`, where a camera without distortion sees it
    std::uint16_t mass = 0;  ///< sum of its darkness, grey levels, saturated
    std::uint16_t area_px = 0;
};

/// Light of one tile.
struct Tile {
    std::uint8_t mean = 0;
    std::uint8_t darkness = 0;  ///< 255 less the level of its darkest pair of pixels
};

/// The newest rows of the image and the light in them. A *band* is a row of tiles.
struct Light {
    int width_px = 0;
    int height_px = 0;
    int band_px = 0;  ///< height of the tiles, 2^band_shift
    int band_shift = 0;
    int tiles_per_band = 0;
    int rows_taken = 0;
    bool has_contrast = false;  ///< anywhere so far
    /// Pixels of the two newest bands; rows are filled up to whole tiles.
    std::span<std::uint8_t> rows;
    std::span<Tile> tiles;  ///< of the four newest bands
    /// What counts as dark in each column of the band being thresholded: pixels darker than the
    /// extent, an even grey level of which this is half, belong to a blob; 0 where nothing does.
    std::span<std::uint8_t> half_extents;
    std::span<std::uint8_t> cores;  ///< some pixel of a blob must be darker than this
};

/// The paper's grey level in the square blocks of an image.
struct PaperMap {
    int block_px = 0;
    int columns = 0;
    int rows = 0;
    std::span<std::uint8_t> levels;     ///< row by row
    std::span<std::uint8_t> brightest;  ///< of each block and the eight around it
};

/// Rows of an image that is being filtered for a second attempt.
struct Smoothing {
    std::span<std::uint16_t> lines;  ///< the five newest, weighted along the row
    std::span<std::uint8_t> row;
    int lines_ready = 0;
    int rows_given = 0;
    PaperMap paper;
    std::span<std::uint32_t> column_sums;  ///< over the rows [sums_begin, sums_end)
    int sums_begin = 0;
    int sums_end = 0;
};

/// A blob that still grows: sums over its pixels, modulo 2^32, which is enough for all that are
/// small enough to be dots.
struct OpenBlob {
    std::uint32_t sum_x = 0;  ///< weight times u
    std::uint32_t sum_y = 0;  ///< weight times v
    std::uint32_t mass = 0;
    std::uint32_t area_px = 0;
    std::uint16_t left = 0;
    std::uint16_t right = 0;  ///< exclusive
    std::uint16_t first_v = 0;
    std::uint16_t last_v = 0;
    /// The blob that it was found to belong to; of one that is not in use, the next such.
    OpenBlob* part_of = nullptr;
    bool has_core = false;
};

/// Stretch of blob pixels in one row.
struct Run {
    std::uint16_t begin = 0;
    std::uint16_t end = 0;    ///< exclusive
    std::uint32_t mass = 0;   ///< sum of weights: darkness below the extent, in grey levels
    std::uint32_t sum_x = 0;  ///< weight times u, modulo 2^32
    bool has_core = false;
    OpenBlob* blob = nullptr;  ///< none if there were too many
};

/// Blobs that reach into the newest thresholded row.
struct OpenBlobs {
    /// Of the newest row and of the one above, in halves; in each, one that ends the row follows.
    std::span<Run> runs;
    int run_count = 0;
    bool newest_in_second_half = false;
    int most_runs = INT32_MAX;  ///< of one image: what exceeds them is not looked at
    int runs_left = 0;
    std::span<OpenBlob> blobs;
    std::size_t blobs_begun = 0;       ///< those after them have not been used in this image
    OpenBlob* first_unused = nullptr;  ///< of those before
};

/// A connection between two seeds that both count each other among their four nearest.
struct Edge {
    std::int16_t from = 0;  ///< index of a seed
    std::int16_t to = 0;
    Vec step_q8;  ///< px, pointing down (or right)
};

/// First estimate of the grid: intersection (i, j) lies at origin + i u + j v in the image.
struct Lattice {
    Vec u_q16;
    Vec v_q16;
    Vec origin_q16;
};

/// Maps image points to the plane of the paper, in spacings: with (x, y) in px from `centre`,
///
///     plane = at_centre + (du x + dv y) / (1 + perspective . (x, y) + lens (x^2 + y^2)),
///
/// which is exact for a tilted camera, for the lens of eq. 2, and for both.
struct PlaneFromImage {
    Vec centre_q8;              ///< px
    Vec at_centre_q16;          ///< spacings
    Vec du_q24;                 ///< spacings per px to the right
    Vec dv_q24;                 ///< spacings per px down
    Vec perspective_q30;        ///< per px
    std::int32_t lens_q40 = 0;  ///< per px^2
};

/// One cell of the matrices P of the paper's Fig. 8.
struct GridCell {
    static constexpr std::uint16_t kNoDot = 65535;
    /// Graphics cover some of the cell's four places: this and a bit for each, by Symbol.
    static constexpr std::uint16_t kHidden = 65504;
    bool has_dot() const { return dot < kHidden; }
    bool is_hidden() const { return dot >= kHidden && dot != kNoDot; }
    bool is_hidden(int symbol) const { return is_hidden() && (dot >> symbol & 1) != 0; }
    std::int8_t x = 0;  ///< quasi-probability of the x bit, in 1/127: positive for 1
    std::int8_t y = 0;
    std::uint16_t dot = kNoDot;  ///< index of the dot read here
};

/// A seed in the order of buckets that lie row by row; and a bucket, which has nothing to do with
/// it but its number.
struct BucketedSeed {
    Vec at_q8;                ///< from the corner of the first bucket
    std::uint16_t seed = 0;   ///< its index
    std::uint16_t begin = 0;  ///< of the bucket: which of the seeds is its first
};

/// Quarter turns of the grid against the pattern: pattern_step = turn(grid_step).
struct Turn {
    int quarters = 0;  ///< 0 to 3, from +x towards +y

    constexpr Vec operator()(Vec grid) const {
        switch (quarters) {
            case 1:
                return {-grid.y, grid.x};
            case 2:
                return {-grid.x, -grid.y};
            case 3:
                return {grid.y, -grid.x};
            default:
                return grid;
        }
    }
    constexpr Turn inverse() const { return {(4 - quarters) % 4}; }
};

/// The matrices P^(x), P^(y) over the cells [i0, i0 + columns) x [j0, j0 + rows).
struct Grid {
    std::span<GridCell> storage;
    int side = 0;  ///< capacity: side * side cells
    int i0 = 0;
    int j0 = 0;
    int columns = 0;
    int rows = 0;

    GridCell& at(int i, int j) const {
        return storage[static_cast<std::size_t>((j - j0) * columns + (i - i0))];
    }
    bool contains(int i, int j) const {
        return i >= i0 && j >= j0 && i < i0 + columns && j < j0 + rows;
    }
};

/// Agreement of one column or row with the main sequence at each of its offsets.
using LineScores = std::array<std::int16_t, kSections>;

/// The score of the best offset, and by how much it leads the second best.
struct Lead {
    std::int16_t best = 0;
    std::int16_t lead = 0;
};

struct ScoredLine {
    LineScores scores{};
    Lead lead;
};

/// A rectangle of grid cells.
struct Region {
    int i0 = 0;
    int j0 = 0;
    int columns = 0;
    int rows = 0;
};

/// Most columns, and most rows, of the grid that a tracked frame may show.
inline constexpr int kMostTracked = 32;

/// Where the cells of a grid lie in an image: cell (i, j) at origin + i along_x + j along_y. Unlike
/// Lattice, upright on the pattern.
struct CellMap {
    Vec origin_q16;  ///< px
    Vec along_x_q16;
    Vec along_y_q16;
};

/// A column (or row) of a tracked frame: one bit for each cell.
struct TrackedLine {
    std::uint32_t code = 0;   ///< what the code has there
    std::uint32_t seen = 0;   ///< whether a dot was read
    std::uint32_t wrong = 0;  ///< of those, whether it contradicts
};

/// A row of cells of a tracked frame: the next one that the image's rows will show, and sums over
/// the dots measured so far, each weighted with its mass.
struct TrackedRow {
    static constexpr std::int32_t kNever_q16 = INT32_MAX;

    Vec next_q16{0,
                 kNever_q16};  ///< where it lies in the image, px; y: kNever_q16 if there is none
    std::int32_t i = 0;        ///< its column
    // Columns are counted from the middle one.
    std::int32_t mass = 0;
    std::int32_t mass_i = 0;
    std::int32_t mass_ii = 0;
    Vec off_q8;  ///< from where the cells have the dots, px
    Vec off_i_q8;
};

/// Where intersections lie of which all pixels that are looked at are in the image.
struct TrackedView {
    Vec least_q16;
    std::uint32_t width_q16 = 0;
    std::uint32_t height_q16 = 0;

    bool has(Vec at_q16) const {
        return static_cast<std::uint32_t>(at_q16.x - least_q16.x) < width_q16 &&
               static_cast<std::uint32_t>(at_q16.y - least_q16.y) < height_q16;
    }
};

/// A frame of which dots are measured where a prediction has them, as its rows come in.
struct Tracking {
    bool is_on = false;  ///< whether the frame that was begun is such a one
    Status status = Status::not_tracked;
    // Small processors reach the first members soonest, so those needed for every dot lead.
    int width_px = 0;
    int height_px = 0;
    int rows_taken = 0;
    int first_kept = 0;  ///< the row of the image that is the first in memory
    int stride_px = 0;
    std::span<std::uint8_t> rows;  ///< the newest of the image
    int cut_q8 = 0;                ///< pixels are dark that lack this share of the paper's level
    std::int32_t least_mass = 0;
    std::int32_t most_mass = 0;
    int dots_measured = 0;
    std::int32_t spacing_q8 = 0;         ///< px
    std::span<TrackedLine> lines;        ///< the columns, and in the second half the rows
    std::array<Vec, 4> displaced_q16{};  ///< by Symbol: of a dot from its intersection, px
    std::array<Vec, 4> off_q8{};         ///< by Symbol: as of the rows, of all of them
    /// By the quarter of its pixel in which an intersection lies, and Symbol: the first of the four
    /// pixels about a dot, in bytes from the intersection's.
    std::array<std::array<std::int16_t, 4>, 4> dot_pixels{};
    CellMap cells;
    /// Spacings per px, in 2^-20.
    Vec du_q20;
    Vec dv_q20;
    std::int32_t displacement_q12 = 0;
    int rows_kept = 0;     ///< at most
    int rows_needed = 0;   ///< of the newest, after dots were looked for: less than half as many
    int first_rows = 0;    ///< from so many on it is known how far the prediction is off
    int next_reading = 0;  ///< when so many rows are taken, dots are looked for
    int reach_px = 0;      ///< so far off may the prediction be at the image centre
    Place corner;          ///< where cell (0, 0) stands in the code
    int first_cell = 0;    ///< per axis, of those that may be in view
    int last_cell = 0;
    std::span<TrackedRow> grid_rows;
    TrackedView view;
};

/// What the grid was read as.
struct Decoding {
    Region window;  ///< the 8 x 8 cells read most clearly
    Region region;  ///< all that is decoded: at most kMaxLines x kMaxLines cells
    /// Of some lines of the region with the main sequence, at the likeliest turn.
    std::int32_t agreement = 0;
    Turn pattern_from_grid;
    Place place;  ///< where grid cell (0, 0) stands in the code, seen or not
    /// Whether `Workspace::line_scores` are those of the region, turned so.
    bool lines_are_scored = false;
    int bits = 0;  ///< compared with those of the code at `place`, two for each dot read
    /// log2 of the probability that the position is wrong along x, along y, times 256.
    std::array<int, 2> p_wrong_log2_q8{};
};

}  // namespace dotpose

#pragma GCC visibility pop

// Stages: what each stage of `locate` keeps and leaves to the next one, in addition to what
// dotpose/trace.hpp shows.
//
// Fixed point: a suffix _qN marks a value in units of 2^-N. Pixel frame: the centre of the first
// pixel is (0, 0), u to the right, v down.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/code.hpp"
#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Width of the tiles in which light is measured, and their height: kLowTile_px for images whose
/// shorter side is at most `kLargestWithLowTiles_px`, kHighTile_px for larger ones. Three tiles
/// must reach over a dot: an image that shows 8 dots along its shorter side has a spacing of at
/// most 1/8 of it, and dots of a third of that.
inline constexpr int kTileWidth_px = 16;
inline constexpr int kLowTile_px = 8;
inline constexpr int kHighTile_px = 16;
inline constexpr int kLargestWithLowTiles_px = 240;
/// Bytes after the last row and the last level that may be read; their values do not matter.
inline constexpr int kReadAhead_px = 8;
/// Half of a low threshold by which every pixel is dark. It ends the search for dark pixels after
/// the last pixel of a row.
inline constexpr std::uint8_t kAlwaysDark = 128;
/// Greatest number of dots, those nearest the image centre, that give the first estimate of the
/// grid.
inline constexpr int kMaxSeeds = 256;
/// Greatest number of cells per axis in the grid of any workspace.
inline constexpr int kMaxGridSide = 256;
/// Greatest number of columns and of rows that are decoded: of more in view, those read most
/// clearly.
inline constexpr int kMaxLines = 64;

/// Grey levels of one tile.
struct Tile {
    std::uint8_t mean = 0;
    std::uint8_t darkness = 0;  ///< 255 minus the level of its darkest pair of pixels
};

/// The newest rows of the image and the light in them. A *band* is a row of tiles.
struct Light {
    int width_px = 0;
    int height_px = 0;
    int band_px = 0;  ///< height of the tiles, 2^band_shift
    int band_shift = 0;
    int tiles_per_band = 0;
    int rows_taken = 0;
    bool has_contrast = false;  ///< whether any tile so far has contrast
    int greatest_contrast = 0;  ///< grey levels between paper and ink, of all tiles so far
    /// Pixels of the two newest bands; rows are filled up to whole tiles.
    std::span<std::uint8_t> rows;
    std::span<Tile> tiles;  ///< tiles of the four newest bands
    /// Low threshold in each column of the band being thresholded, halved: pixels darker than twice
    /// this grey level belong to a blob; 0 where no pixel does.
    std::span<std::uint8_t> half_low_levels;
    std::span<std::uint8_t> high_levels;  ///< high threshold: some pixel of a blob must be darker
                                          ///< than this grey level
};

/// Grey level of the paper in the square blocks of an image.
struct PaperMap {
    int block_px = 0;
    int columns = 0;
    int rows = 0;
    std::span<std::uint8_t> levels;     ///< row by row
    std::span<std::uint8_t> brightest;  ///< brightest level among each block and the eight around
                                        ///< it
};

/// Rows of an image that is being filtered for a second attempt.
struct Smoothing {
    std::span<std::uint16_t> lines;  ///< the five newest rows, weighted along the row
    std::span<std::uint8_t> row;
    int lines_ready = 0;
    int rows_given = 0;
    PaperMap paper;
    std::span<std::uint32_t> column_sums;  ///< sums over the rows [sums_begin, sums_end)
    int sums_begin = 0;
    int sums_end = 0;
};

/// A blob that still grows, as sums over its pixels. The sums are modulo 2^32, which does not
/// matter for blobs small enough to be dots.
struct OpenBlob {
    std::uint32_t sum_x = 0;  ///< sum of weight times u
    std::uint32_t sum_y = 0;  ///< sum of weight times v
    std::uint32_t mass = 0;
    std::uint32_t area_px = 0;
    std::uint16_t left = 0;
    std::uint16_t right = 0;  ///< exclusive
    std::uint16_t first_v = 0;
    std::uint16_t last_v = 0;
    /// The blob that this one was merged into; for an unused one, the next unused blob.
    OpenBlob* part_of = nullptr;
    bool passes_high = false;  ///< whether a pixel is darker than the high threshold
};

/// A stretch of blob pixels in one row.
struct Run {
    std::uint16_t begin = 0;
    std::uint16_t end = 0;     ///< exclusive
    std::uint32_t mass = 0;    ///< sum of weights: darkness below the low threshold, in grey levels
    std::uint32_t sum_x = 0;   ///< sum of weight times u, modulo 2^32
    bool passes_high = false;  ///< whether a pixel is darker than the high threshold
    OpenBlob* blob = nullptr;  ///< blob of the run; none if there were too many
};

/// Blobs that reach into the newest thresholded row.
struct OpenBlobs {
    /// Runs of the newest row and of the one above, one half each; a sentinel run ends each row.
    std::span<Run> runs;
    int run_count = 0;
    bool newest_in_second_half = false;
    int most_runs = INT32_MAX;  ///< limit for one image; further runs are ignored
    int runs_left = 0;
    std::span<OpenBlob> blobs;
    std::size_t blobs_begun = 0;       ///< blobs after these have not been used in this image
    OpenBlob* first_unused = nullptr;  ///< first unused blob among those before
};

/// Two unrelated records that share an index: a seed, in the order of buckets that lie row by row,
/// and a bucket.
struct BucketedSeed {
    Vec at_q8;                ///< place of the seed, from the corner of the first bucket
    std::uint16_t seed = 0;   ///< index of the seed
    std::uint16_t begin = 0;  ///< index of the bucket's first seed in this order
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

/// The score of the best offset, and its margin over the second best.
struct BestScore {
    std::int16_t score = 0;
    std::int16_t margin = 0;
};

/// A column or row with its scores.
struct ScoredLine {
    LineScores scores{};
    BestScore best;
};

/// Greatest number of columns, and of rows, of the grid in a tracked frame.
inline constexpr int kMostTracked = 32;

/// Where the cells of a grid lie in an image: cell (i, j) at origin + i along_x + j along_y. Unlike
/// a Lattice, it is upright on the pattern.
struct CellMap {
    Vec origin_q16;  ///< px
    Vec along_x_q16;
    Vec along_y_q16;
};

/// A column (or row) of a tracked frame, with one bit for each cell.
struct TrackedLine {
    std::uint32_t code = 0;   ///< bits of the code
    std::uint32_t seen = 0;   ///< 1 where a dot was read
    std::uint32_t wrong = 0;  ///< 1 where the dot read contradicts the code
};

/// A row of cells of a tracked frame: its next cell that the rows of the image will show, and sums
/// over the dots measured so far, each weighted with its mass.
struct TrackedRow {
    static constexpr std::int32_t kNever_q16 = INT32_MAX;

    Vec next_q16{0,
                 kNever_q16};  ///< where it lies in the image, px; y: kNever_q16 if there is none
    std::int32_t i = 0;        ///< column of that cell
    // The following sums count columns from the middle one.
    std::int32_t mass = 0;
    std::int32_t mass_i = 0;
    std::int32_t mass_ii = 0;
    Vec off_q8;  ///< sum of the dots' distances from their expected places, px
    Vec off_i_q8;
};

/// The range of intersections around which all pixels that are examined are in the image.
struct TrackedView {
    Vec least_q16;
    std::uint32_t width_q16 = 0;
    std::uint32_t height_q16 = 0;

    bool has(Vec at_q16) const {
        return static_cast<std::uint32_t>(at_q16.x - least_q16.x) < width_q16 &&
               static_cast<std::uint32_t>(at_q16.y - least_q16.y) < height_q16;
    }
};

/// A frame whose dots are measured where a prediction expects them, as its rows come in. Of a frame
/// that shows too many cells the middle is tracked, which then counts as the image.
struct Tracking {
    bool is_on = false;  ///< whether the frame that was begun is tracked
    Status status = Status::not_tracked;
    std::uint8_t min_contrast = 0;  ///< see Options
    // Small processors reach the first members soonest, so those needed for every dot come first.
    int width_px = 0;
    int height_px = 0;
    int rows_taken = 0;  ///< negative while rows above the part that is tracked come in
    int first_kept = 0;  ///< row of the image that is the first in memory
    int stride_px = 0;
    std::span<std::uint8_t> rows;  ///< the newest rows of the image
    int cut_q8 = 0;  ///< share of the paper's level, in 1/256, by which a dark pixel is darker
    std::int32_t least_mass = 0;
    std::int32_t most_mass = 0;
    int dots_measured = 0;
    std::int32_t spacing_q8 = 0;         ///< px
    std::span<TrackedLine> lines;        ///< the columns, then in the second half the rows
    std::array<Vec, 4> displaced_q16{};  ///< by Symbol: offset of a dot from its intersection, px
    std::array<Vec, 4> off_q8{};         ///< by Symbol: sum of `off_q8` over all rows
    /// By the quarter of its pixel in which an intersection lies, and by Symbol: offset of the
    /// first of the four pixels about a dot, in bytes from the intersection's pixel.
    std::array<std::array<std::int16_t, 4>, 4> dot_pixels{};
    std::int16_t left_out_px = 0;  ///< columns to the left of the part that is tracked
    std::int16_t rows_above = 0;   ///< rows above it
    CellMap cells;
    /// Pattern steps per image step, in 2^-20 spacings per px.
    Vec du_q20;
    Vec dv_q20;
    std::int32_t displacement_q12 = 0;
    int rows_kept = 0;     ///< greatest number of rows in memory
    int rows_needed = 0;   ///< number of newest rows that must stay after dots were read: less than
                           ///< half of rows_kept
    int first_rows = 0;    ///< number of rows from which it is known how far the prediction is off
    int next_reading = 0;  ///< number of rows taken at which dots are read next
    int reach_px = 0;      ///< greatest error of the prediction at the image centre, px
    Place corner;          ///< place of cell (0, 0) in the code
    int first_cell = 0;    ///< first cell, per axis, that may be in view
    int last_cell = 0;
    std::span<TrackedRow> grid_rows;
    TrackedView view;
};

}  // namespace dotpose::core

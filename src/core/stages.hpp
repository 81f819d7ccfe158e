// Stages: the data that each stage of `locate` stores for the next stages, in addition to those in
// dotpose/trace.hpp.
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

/// Width and height of the tiles of the adaptive threshold. The height is kLowTile_px for images
/// whose shorter side is at most `kMaxSideWithLowTiles_px`, and kHighTile_px for larger images.
/// Three tiles must contain a dot: an image with 8 dots along its shorter side has a spacing of at
/// most 1/8 of that side, and dots of at most a third of the spacing.
inline constexpr int kTileWidth_px = 16;
inline constexpr int kLowTile_px = 8;
inline constexpr int kHighTile_px = 16;
inline constexpr int kMaxSideWithLowTiles_px = 240;
/// Bytes after the last row and the last level that may be read. Their values have no effect.
inline constexpr int kReadAhead_px = 8;
/// Half of a low threshold for which every pixel is dark. It ends the search for dark pixels after
/// the last pixel of a row.
inline constexpr std::uint8_t kAlwaysDark = 128;
/// Maximum number of seeds: the dots nearest the image centre, which give the first estimate of the
/// grid.
inline constexpr int kMaxSeeds = 256;
/// Maximum number of cells per axis in the grid of any workspace.
inline constexpr int kMaxGridSide = 256;
/// Maximum number of columns and of rows that are decoded. If more lines are in view, the lines
/// read most clearly are decoded.
inline constexpr int kMaxLines = 64;

/// Grey levels of one tile.
struct Tile {
    std::uint8_t mean = 0;
    std::uint8_t darkness = 0;  ///< 255 minus the level of its darkest pair of pixels
};

/// The newest rows of the image with their tiles, and the thresholds of one band. A *band* is a row
/// of tiles.
struct AdaptiveThreshold {
    int width_px = 0;
    int height_px = 0;
    int band_px = 0;  ///< height of the tiles, 2^band_shift
    int band_shift = 0;
    int tiles_per_band = 0;
    int rows_taken = 0;
    bool has_contrast = false;  ///< true if any tile so far has contrast
    int max_contrast =
        0;  ///< largest contrast between paper and ink of all tiles so far, in grey levels
    /// Pixels of the two newest bands. Rows are filled up to whole tiles.
    std::span<std::uint8_t> rows;
    std::span<Tile> tiles;  ///< tiles of the four newest bands
    /// Low threshold in each column of the current band, halved: pixels darker than twice this
    /// level belong to a blob. 0 if no pixel does.
    std::span<std::uint8_t> half_low_levels;
    std::span<std::uint8_t>
        high_levels;  ///< high threshold: a blob must have a pixel darker than this level
};

/// Paper level in the square blocks of an image.
struct PaperMap {
    int block_px = 0;
    int columns = 0;
    int rows = 0;
    std::span<std::uint8_t> levels;     ///< row by row
    std::span<std::uint8_t> brightest;  ///< brightest level of each block and the eight around it
};

/// Rows of an image during the filtering of the second attempt.
struct Smoothing {
    std::span<std::uint16_t> lines;  ///< the five newest rows, filtered along the row
    std::span<std::uint8_t> row;
    int lines_ready = 0;
    int rows_given = 0;
    PaperMap paper;
    std::span<std::uint32_t> column_sums;  ///< column sums over the rows [sums_begin, sums_end)
    int sums_begin = 0;
    int sums_end = 0;
};

/// A blob that may continue in the next row, as sums over its pixels. The sums are modulo 2^32,
/// which is exact for blobs small enough to be dots.
struct OpenBlob {
    std::uint32_t sum_x = 0;  ///< sum of weight times u
    std::uint32_t sum_y = 0;  ///< sum of weight times v
    std::uint32_t mass = 0;
    std::uint32_t area_px = 0;
    std::uint16_t left = 0;
    std::uint16_t right = 0;  ///< exclusive
    std::uint16_t first_v = 0;
    std::uint16_t last_v = 0;
    /// Blob that this one was merged into. For an unused blob, the next unused blob.
    OpenBlob* part_of = nullptr;
    bool passes_high = false;  ///< true if a pixel is darker than the high threshold
};

/// A stretch of blob pixels in one row.
struct Run {
    std::uint16_t begin = 0;
    std::uint16_t end = 0;     ///< exclusive
    std::uint32_t mass = 0;    ///< sum of weights: darkness below the low threshold, in grey levels
    std::uint32_t sum_x = 0;   ///< sum of weight times u, modulo 2^32
    bool passes_high = false;  ///< true if a pixel is darker than the high threshold
    OpenBlob* blob = nullptr;  ///< blob of the run; null if there were too many
};

/// Blobs with pixels in the newest thresholded row.
struct OpenBlobs {
    /// Runs of the newest row and of the row above, in one half each. A sentinel run ends each row.
    std::span<Run> runs;
    int run_count = 0;
    bool newest_in_second_half = false;
    int max_runs = INT32_MAX;  ///< limit per image; further runs are ignored
    int runs_left = 0;
    std::span<OpenBlob> blobs;
    std::size_t blobs_begun = 0;       ///< number of blobs used in this image so far
    OpenBlob* first_unused = nullptr;  ///< first unused blob among `blobs`
};

/// Element n of two unrelated arrays: the n-th seed, sorted by bucket in row-major order, and the
/// n-th bucket.
struct BucketedSeed {
    Vec at_q8;                ///< place of the seed relative to the corner of the first bucket
    std::uint16_t seed = 0;   ///< index of the seed
    std::uint16_t begin = 0;  ///< index of the first seed of the bucket in this order
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

/// Agreement of one column or row with the main sequence at each roll.
using LineScores = std::array<std::int16_t, kSections>;

/// The best score, and its margin over the second best.
struct BestScore {
    std::int16_t score = 0;
    std::int16_t margin = 0;
};

/// A column or row with its scores.
struct ScoredLine {
    LineScores scores{};
    BestScore best;
};

/// Maximum number of columns, and of rows, of the grid in a tracked frame.
inline constexpr int kMaxTracked = 32;

/// Map from the cells of a grid to the image: cell (i, j) is at origin + i along_x + j along_y.
/// Unlike a Lattice, it is upright on the pattern.
struct CellMap {
    Vec origin_q16;  ///< px
    Vec along_x_q16;
    Vec along_y_q16;
};

/// A column (or row) of a tracked frame, with one bit for each cell.
struct TrackedLine {
    std::uint32_t code = 0;   ///< bits of the code
    std::uint32_t seen = 0;   ///< 1 if a dot was read
    std::uint32_t wrong = 0;  ///< 1 if the dot read contradicts the code
};

/// A row of cells of a tracked frame: its next cell in the order of the image rows, and sums over
/// the dots measured so far, weighted with their masses.
struct TrackedRow {
    static constexpr std::int32_t kNever_q16 = INT32_MAX;

    Vec next_q16{
        0, kNever_q16};  ///< place of that cell in the image, px; y is kNever_q16 if there is none
    std::int32_t i = 0;  ///< column of that cell
    // Columns in the following sums are relative to the middle column.
    std::int32_t mass = 0;
    std::int32_t mass_i = 0;
    std::int32_t mass_ii = 0;
    Vec offset_q8;  ///< sum of the offsets of dots from their predicted places, px
    Vec offset_i_q8;
};

/// The range of intersections around which all examined pixels are in the image.
struct TrackedView {
    Vec min_q16;
    std::uint32_t width_q16 = 0;
    std::uint32_t height_q16 = 0;

    bool has(Vec at_q16) const {
        return static_cast<std::uint32_t>(at_q16.x - min_q16.x) < width_q16 &&
               static_cast<std::uint32_t>(at_q16.y - min_q16.y) < height_q16;
    }
};

/// A frame whose dots are measured at predicted places while its rows arrive. If a frame shows too
/// many cells, only its middle is tracked and counts as the image.
struct Tracking {
    bool is_on = false;  ///< true if the current frame is tracked
    Status status = Status::not_tracked;
    std::uint8_t min_contrast = 0;  ///< see Options
    // Small processors access the first members fastest. The members used for every dot are
    // therefore first.
    int width_px = 0;
    int height_px = 0;
    int rows_taken = 0;  ///< negative before the first row of the tracked part
    int first_kept = 0;  ///< row of the image that is the first in memory
    int stride_px = 0;
    std::span<std::uint8_t> rows;  ///< the newest rows of the image
    int cut_q8 = 0;                ///< contrast of a dark pixel, in 1/256 of the paper level
    std::int32_t min_mass = 0;
    std::int32_t max_mass = 0;
    int dots_measured = 0;
    std::int32_t spacing_q8 = 0;         ///< px
    std::span<TrackedLine> lines;        ///< the columns, then in the second half the rows
    std::array<Vec, 4> displaced_q16{};  ///< by Symbol: offset of a dot from its intersection, px
    std::array<Vec, 4> offset_q8{};      ///< by Symbol: sum of `offset_q8` over all rows
    /// Offset of the first of the four pixels around a dot, in bytes from the pixel of the
    /// intersection. By the quarter of that pixel that contains the intersection, and by Symbol.
    std::array<std::array<std::int16_t, 4>, 4> dot_pixels{};
    std::int16_t left_out_px = 0;  ///< columns to the left of the tracked part
    std::int16_t rows_above = 0;   ///< rows above the tracked part
    CellMap cells;
    /// Change of the pattern point per image px, in 2^-20 spacings per px.
    Vec du_q20;
    Vec dv_q20;
    std::int32_t displacement_q12 = 0;
    int rows_kept = 0;     ///< maximum number of rows in memory
    int rows_needed = 0;   ///< number of newest rows that are still needed after dots were read:
                           ///< less than half of rows_kept
    int first_rows = 0;    ///< number of rows that determine the error of the prediction
    int next_reading = 0;  ///< value of rows_taken at which dots are read next
    int reach_px = 0;      ///< maximum error of the prediction at the image centre, px
    Place corner;          ///< place of cell (0, 0) in the code
    int first_cell = 0;    ///< first cell, per axis, that may be in view
    int last_cell = 0;
    std::span<TrackedRow> grid_rows;
    TrackedView view;
};

}  // namespace dotpose::core

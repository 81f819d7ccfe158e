// Tracking: the state of a frame that a DeviceLocator tracks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/integrity/compared_line.hpp"
#include "dotpose/code.hpp"
#include "dotpose/geometry.hpp"
#include "dotpose/status.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::core {

/// Map from the cells of a grid to the image: cell (i, j) is at origin + i along_x + j along_y. The
/// axes of the cells are the axes of the upright pattern, unlike the axes of a Lattice.
struct CellMap {
    FixedVec origin_q16;  ///< in 2^-16 px
    FixedVec along_x_q16;
    FixedVec along_y_q16;
};

/// State of one row of cells in a tracked frame: the next cell to read, and mass-weighted sums over
/// the dots measured so far. The cells of a row are read in the order in which their image rows
/// arrive.
struct TrackedRow {
    static constexpr std::int32_t kNever_q16 = INT32_MAX;

    /// Image point of the next intersection, in 2^-16 px. y is kNever_q16 if there is no next cell.
    FixedVec next_q16{0, kNever_q16};
    std::int32_t i = 0;  ///< column of the next cell
    // Sums of mass, mass * i and mass * i^2 over the measured dots. In all sums, i is the column of
    // a dot relative to the middle column.
    std::int32_t mass = 0;
    std::int32_t mass_i = 0;
    std::int32_t mass_ii = 0;
    /// Mass-weighted sums of the offsets of dots from their predicted centres, in 2^-8 px. In
    /// `offset_i_q8`, each offset is also multiplied by i.
    FixedVec offset_q8;
    FixedVec offset_i_q8;
};

/// Rectangle in the image, in 2^-16 px. If an intersection is in this rectangle, all pixels that
/// are read for its dot are in the image.
struct TrackedView {
    FixedVec min_q16;
    std::uint32_t width_q16 = 0;
    std::uint32_t height_q16 = 0;

    bool has(FixedVec at_q16) const {
        return static_cast<std::uint32_t>(at_q16.x - min_q16.x) < width_q16 &&
               static_cast<std::uint32_t>(at_q16.y - min_q16.y) < height_q16;
    }
};

/// A frame whose dots are measured near their predicted centres while its rows arrive. If the frame
/// contains more cells than the memory has room for, only its middle part is tracked. All stages
/// then treat this part as the whole image.
struct Tracking {
    Status status = Status::not_tracked;
    std::uint8_t min_contrast = 0;  ///< see DeviceOptions
    /// Half-width of the square in which a symbol is read, in px (see `set_half_side`).
    std::uint8_t half_side_px = 0;
    // The members that are used for every dot come first, because small processors access the first
    // members fastest.
    int width_px = 0;
    int height_px = 0;
    /// Number of rows of the tracked part that have been received. Starts at -`rows_above`, so it
    /// is negative until all rows above the tracked part have been received.
    int rows_taken = 0;
    int first_kept = 0;  ///< index of the first stored image row
    int stride_px = 0;
    /// Byte offsets within the square from which a symbol is read. `corner_offset` is the offset
    /// from the middle pixel to the upper left corner. `corners_apart` is the offset from an upper
    /// corner to the lower corner on the same side.
    std::ptrdiff_t corner_offset = 0;
    std::ptrdiff_t corners_apart = 0;
    std::span<std::uint8_t> rows;  ///< the newest rows of the image
    int cut_q8 = 0;  ///< minimum contrast of a dark pixel, in 1/256 of the paper level
    std::int32_t min_mass = 0;
    std::int32_t max_mass = 0;
    int dots_measured = 0;
    std::int32_t spacing_q8 = 0;    ///< in 2^-8 px
    std::span<ComparedLine> lines;  ///< first half: columns; second half: rows
    /// Displacement of a dot from its intersection, in 2^-16 px, indexed by Symbol.
    std::array<FixedVec, 4> displaced_q16{};
    /// Mass-weighted sums of the offsets of all dots from their predicted centres, in 2^-8 px.
    /// Indexed by Symbol.
    std::array<FixedVec, 4> offset_q8{};
    /// Offset, in bytes, from the pixel that contains an intersection to the first of the four
    /// pixels of its dot. Indexed by the pixel quadrant that contains the intersection, and by
    /// Symbol.
    std::array<std::array<std::int16_t, 4>, 4> dot_pixels{};
    std::int16_t min_side_px = 0;  ///< minimum width and height of the tracked part
    std::int16_t left_out_px = 0;  ///< number of columns to the left of the tracked part
    std::int16_t rows_above = 0;   ///< number of rows above the tracked part
    /// True if the cells are too small, too large or too deformed to measure each dot around its
    /// predicted centre. The frame is then tracked by device/fine_dots and device/fine_grid.
    bool is_fine = false;
    CellMap cells;
    /// Derivatives of the pattern point with respect to the image coordinates u and v, in 2^-20
    /// spacings per px.
    FixedVec du_q20;
    FixedVec dv_q20;
    std::int32_t displacement_q12 = 0;
    int rows_kept = 0;  ///< maximum number of rows that can be stored
    /// Number of rows at the top of the tracked part in which the prediction error is measured. In
    /// fine grids, this is the value of `rows_taken` at which the next search for dots begins.
    int first_rows = 0;
    /// Value of `rows_taken` at which the next dots are read. In fine grids, this is the first row
    /// of the next search for dots.
    int next_reading = 0;
    int reach_px = 0;  ///< maximum position error that the search covers, in px at the image centre
    Place corner;      ///< place of cell (0, 0) in the code
    int first_cell = 0;  ///< first cell, along each axis, that may be in view
    int last_cell = 0;
    std::span<TrackedRow> grid_rows;
    TrackedView view;
    /// The first `dots_measured` elements are the dots found in the stored rows so far (see
    /// `find_fine_dots`). Their centres are relative to the middle of the image.
    std::span<DetectedDot> found;
};

}  // namespace dotpose::core

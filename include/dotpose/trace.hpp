/// Trace: the results of each stage of `Locator::locate` for the last frame. Intended for drawing,
/// evaluation and calibration. The trace is read-only. Its members follow the implementation of the
/// stages, so it is not a stable interface.
///
///     DeviceOptions options;
///     options.show_stages = true;  // otherwise the first and the tracked attempt store little
///     Locator locator(memory, options);
///     const Fix fix = locator.locate(image);
///     for (const DetectedDot& dot : locator.trace().dots) ...
///
/// Fixed point: the suffix _qN marks a value in units of 2^-N.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/code.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/geometry.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Side of the decoding window, in cells (paper, section II-B.5).
inline constexpr int kWindowSide = 8;

/// Detected dot.
struct DetectedDot {
    FixedVec centre_q8;      ///< in 2^-8 px, corrected for lens distortion
    std::uint16_t mass = 0;  ///< summed darkness of the dot's pixels, in grey levels; at most 65535
    std::uint16_t area_px = 0;
};

/// Edge between two seeds, each of which is among the four nearest neighbours of the other. Seeds
/// are the dots from which the lattice is found.
struct SeedEdge {
    std::int16_t from = 0;  ///< index of a seed
    std::int16_t to = 0;
    /// Vector from `from` to `to`, in 2^-8 px. Points down or, if horizontal, right.
    FixedVec step_q8;
};

/// Initial estimate of the grid. In the image, intersection (i, j) is at origin + i u + j v. All
/// vectors are in units of 2^-16 px.
struct Lattice {
    FixedVec u_q16;
    FixedVec v_q16;
    FixedVec origin_q16;
};

/// Cell of the grid, with the entries for this cell in the matrices P (paper, figure 8).
struct GridCell {
    static constexpr std::uint16_t kNoDot = 65535;
    /// Marks a cell in which graphics cover some of the four possible dot positions. The low bits
    /// are a mask of the covered positions, indexed by Symbol.
    static constexpr std::uint16_t kHidden = 65504;
    bool has_dot() const { return dot < kHidden; }
    bool is_hidden() const { return dot >= kHidden && dot != kNoDot; }
    bool is_hidden(int symbol) const { return is_hidden() && (dot >> symbol & 1) != 0; }
    /// Quasi-probabilities of the x bit and the y bit (paper, equation 9), from -127 (certainly 0)
    /// to 127 (certainly 1).
    std::int8_t x = 0;
    std::int8_t y = 0;
    /// Index of the cell's dot, kNoDot, or kHidden plus the mask.
    std::uint16_t dot = kNoDot;
};

/// Rotation from the grid to the pattern, in quarter turns: pattern_step = turn(grid_step).
struct QuarterTurn {
    int quarters = 0;  ///< number of quarter turns, 0 to 3, from +x towards +y

    /// Converts a grid step to a pattern step.
    constexpr FixedVec operator()(FixedVec grid) const {
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
    /// Returns the rotation from the pattern to the grid.
    constexpr QuarterTurn inverse() const { return {(4 - quarters) % 4}; }
};

/// Rectangle of grid cells: columns i0 to i0 + columns - 1, rows j0 to j0 + rows - 1.
struct GridRegion {
    int i0 = 0;
    int j0 = 0;
    int columns = 0;
    int rows = 0;
};

/// Decoded position of the grid.
struct Decoding {
    GridRegion window;  ///< the clearest window of 8 x 8 cells
    GridRegion region;  ///< all decoded cells, at most kMaxLines x kMaxLines
    /// Total score of the columns and rows that voted on the quarter turn: a measure of how well
    /// their bits match the main sequence.
    std::int32_t agreement = 0;
    QuarterTurn pattern_from_grid;
    Place place;  ///< place of grid cell (0, 0) in the code; this cell may be outside the view
    /// True if the workspace contains the line scores of the region, rotated by
    /// `pattern_from_grid`.
    bool lines_are_scored = false;
    int bits = 0;  ///< number of bits that were compared with the code at `place`; two per dot
};

/// The matrices P^(x) and P^(y) (paper, figure 8), for a rectangle of grid cells.
struct GridView {
    std::span<const GridCell> cells;  ///< row by row
    GridRegion region;                ///< grid region of `cells`

    /// Returns the cell in grid column i and row j. The cell must be in the region.
    const GridCell& at(int i, int j) const {
        return cells[static_cast<std::size_t>((j - region.j0) * region.columns + (i - region.i0))];
    }
    /// Returns true if the region contains the cell in grid column i and row j.
    bool contains(int i, int j) const {
        return i >= region.i0 && j >= region.j0 && i < region.i0 + region.columns &&
               j < region.j0 + region.rows;
    }
};

/// Results of all stages for the last frame, in the order of the stages. The spans are valid until
/// the next frame begins.
struct Trace {
    DeviceOptions options;  ///< options used by the Locator, with the code variant of the fix
    std::span<const DetectedDot> dots;
    std::span<const std::uint16_t> seeds;  ///< indices of the dots from which the lattice was found
    std::span<const SeedEdge> edges;       ///< edges between seeds
    Lattice lattice;
    PlaneFromImage grid_from_image;
    GridView grid;
    Decoding decoding;
    /// Map from the image to the pattern, in spacings relative to `decoding.place`.
    PlaneFromImage pattern_from_image;
    Fix fix;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT

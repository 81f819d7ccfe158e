/// Trace: what each stage of `Locator::locate` left behind for the last frame, for drawing, judging
/// and calibrating. It is read-only and not stable: it changes whenever the stages do.
///
///     Options options;
///     options.show_stages = true;  // without it, the first and the tracked attempt leave little
///     Locator locator(memory, options);
///     const Fix fix = locator.locate(image);
///     for (const Dot& dot : locator.trace().dots) ...
///
/// Fixed point: a suffix _qN marks a value in units of 2^-N.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "dotpose/code.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/geometry.hpp"
#include "dotpose/options.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Side of the decoding window of the paper (section II-B.5).
inline constexpr int kWindowSide = 8;

/// A detected dot.
struct Dot {
    Vec centre_q8;           ///< px, as a camera without distortion would see it
    std::uint16_t mass = 0;  ///< sum of the darkness of its pixels, grey levels, saturated
    std::uint16_t area_px = 0;
};

/// A connection between two seeds, each among the four nearest of the other.
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

/// One cell of the matrices P of the paper's Fig. 8.
struct GridCell {
    static constexpr std::uint16_t kNoDot = 65535;
    /// With this value graphics cover some of the cell's four places; the low bits say which, by
    /// Symbol.
    static constexpr std::uint16_t kHidden = 65504;
    bool has_dot() const { return dot < kHidden; }
    bool is_hidden() const { return dot >= kHidden && dot != kNoDot; }
    bool is_hidden(int symbol) const { return is_hidden() && (dot >> symbol & 1) != 0; }
    std::int8_t x = 0;  ///< quasi-probability of the x bit, in 1/127: positive for 1, negative for
                        ///< 0
    std::int8_t y = 0;
    std::uint16_t dot = kNoDot;  ///< index of the dot read here; kNoDot: none
};

/// Quarter turns from the grid to the pattern: pattern_step = turn(grid_step).
struct Turn {
    int quarters = 0;  ///< 0 to 3, from +x towards +y

    /// Returns a step of the grid as a step of the pattern.
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
    /// Returns the turn from the pattern to the grid.
    constexpr Turn inverse() const { return {(4 - quarters) % 4}; }
};

/// A rectangle of grid cells.
struct Region {
    int i0 = 0;
    int j0 = 0;
    int columns = 0;
    int rows = 0;
};

/// The position that the grid was read as.
struct Decoding {
    Region window;  ///< the 8 x 8 cells read most clearly
    Region region;  ///< all cells that are decoded: at most kMaxLines x kMaxLines
    /// Agreement of some lines of the region with the main sequence, at the likeliest turn.
    std::int32_t agreement = 0;
    Turn pattern_from_grid;
    Place place;  ///< place of grid cell (0, 0) in the code, whether it was seen or not
    /// Whether the core keeps the scores of the region's lines for this turn.
    bool lines_are_scored = false;
    int bits = 0;  ///< number of bits compared with the code at `place`: two for each dot read
    /// log2 of the probability that the position is wrong along x and along y, times 256.
    std::array<int, 2> p_wrong_log2_q8{};
};

/// The matrices P^(x), P^(y) of the paper's Fig. 8 over a rectangle of the grid.
struct GridView {
    std::span<const GridCell> cells;  ///< row by row
    Region region;                    ///< the cells of the grid that they are

    /// Returns the cell in column i and row j of the grid, which must be in the region.
    const GridCell& at(int i, int j) const {
        return cells[static_cast<std::size_t>((j - region.j0) * region.columns + (i - region.i0))];
    }
    /// Whether the region has the cell in column i and row j of the grid.
    bool contains(int i, int j) const {
        return i >= region.i0 && j >= region.j0 && i < region.i0 + region.columns &&
               j < region.j0 + region.rows;
    }
};

/// The results of the stages for the last frame, in order. The spans are valid until the next frame
/// begins.
struct Trace {
    Options options;  ///< options of the Locator; `profile` is the one that was read
    std::span<const Dot> dots;
    std::span<const std::uint16_t> seeds;  ///< indices of the dots that the lattice was found from
    std::span<const Edge> edges;           ///< between seeds
    Lattice lattice;
    PlaneFromImage grid_from_image;
    GridView grid;
    Decoding decoding;
    PlaneFromImage pattern_from_image;  ///< in spacings from `decoding.place`
    Fix fix;
};

}  // namespace dotpose

#pragma GCC visibility pop

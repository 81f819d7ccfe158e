// Print dots: measures the dots of a part of a scan where a map expects them.
#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/print_map.hpp"
#include "dotpose/image.hpp"

namespace dotpose::calibrate {

/// What is known of the print before measuring: which dots stand where.
struct Code {
    CodeVariant code = CodeVariant::anoto;
    Section section;
    double displacement = 1.0 / 6;  ///< in spacings

    Symbol symbol(std::int64_t x, std::int64_t y) const;
    /// Returns the nominal place of a dot, in cells.
    Eigen::Vector2d dot_cell(std::int64_t x, std::int64_t y, Symbol symbol) const;
};

/// The measurement of one cell. Darkness is relative to the paper: 0 paper, 1 black.
struct SeenCell {
    std::uint32_t x = 0;  ///< column of the cell
    std::uint32_t y = 0;
    Symbol nominal = Symbol::up;
    bool is_covered = false;  ///< whether other print crosses the cell's border, where no dot comes
                              ///< near
    Symbol read = Symbol::up;  ///< valid with a dot only, as all members below
    bool has_dot = false;
    float u_px = 0;  ///< centre
    float v_px = 0;
    float strength = 0;  ///< mean darkness around its middle, relative to the expected one; always
                         ///< valid
    float mass_px2 = 0;  ///< sum of darkness over the dot
    float peak = 0;      ///< darkness of its middle
    float paper = 0;     ///< grey level of the blank paper around

    Eigen::Vector2d centre_px() const { return {u_px, v_px}; }
    bool is_right() const { return has_dot && read == nominal; }
};

/// How bright paper and dots are in a part of a scan.
struct PrintLevels {
    double paper = 0;  ///< grey level of the blank paper between dots; 0: no paper is visible
    double noise = 0;  ///< standard deviation of the darkness of blank paper
    double dot = 0;    ///< median darkness of a dot's middle
};

/// Returns the levels around dots that were read, given by their centres in px.
PrintLevels measure_levels(const ImageView& scan, const TileMap& map,
                           const std::vector<Eigen::Vector2d>& dots_px);

/// Measures all cells of the code plane whose intersections lie in `rect` or within half a spacing
/// of it. Returns none if no paper is visible.
std::vector<SeenCell> measure_cells(const ImageView& scan, const PixelRect& rect,
                                    const TileMap& map, const PrintLevels& levels,
                                    const Code& code);

/// Returns the darkness at a point, 0 for paper and 1 for black, by interpolation.
double darkness_at(const ImageView& scan, const Eigen::Vector2d& pixel, double paper);

}  // namespace dotpose::calibrate

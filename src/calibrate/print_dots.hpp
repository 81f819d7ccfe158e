// Measures the dots in a scan at the positions that a map predicts.
#pragma once

#include <cstdint>
#include <vector>

#include "calibrate/print_map.hpp"
#include "dotpose/image.hpp"

namespace dotpose::calibrate {

/// Code of a field. Determines the nominal position of each dot.
struct Code {
    CodeVariant code = CodeVariant::anoto;
    Section section;
    double displacement = 1.0 / 6;  ///< displacement of the dots, in spacings

    Symbol symbol(std::int64_t x, std::int64_t y) const;
    /// Returns the nominal position of a dot, in cells.
    Eigen::Vector2d dot_cell(std::int64_t x, std::int64_t y, Symbol symbol) const;
};

/// Measurement of one cell. Darkness is relative to the paper: 0 is paper, 1 is black.
struct SeenCell {
    std::uint32_t x = 0;  ///< column of the cell
    std::uint32_t y = 0;
    Symbol nominal = Symbol::up;
    /// True if the border of the cell is not blank. Dots do not extend to the border, so something
    /// that is not part of the pattern, such as text, is printed there.
    bool is_covered = false;
    /// Symbol that was read. This member and all members below except `strength` are valid only if
    /// `has_dot` is true.
    Symbol read = Symbol::up;
    bool has_dot = false;
    float u_px = 0;  ///< centre of the dot in the scan
    float v_px = 0;
    /// Mean darkness of the dot relative to the expected darkness. Always valid.
    float strength = 0;
    float mass_px2 = 0;  ///< integral of the darkness over the dot
    float peak = 0;      ///< darkness at the centre of the dot
    float paper = 0;     ///< grey level of the blank paper around the dot

    Eigen::Vector2d centre_px() const { return {u_px, v_px}; }
    bool is_right() const { return has_dot && read == nominal; }
};

/// Brightness of paper and dots in a part of a scan.
struct PrintLevels {
    double paper = 0;  ///< grey level of the blank paper between dots, or 0 if no paper is visible
    double noise = 0;  ///< standard deviation of the darkness of blank paper
    double dot = 0;    ///< median darkness around the centre of a dot
};

/// Measures the brightness of paper and dots in the neighbourhood of the given dot centres.
PrintLevels measure_levels(const ImageView& scan, const TileMap& map,
                           const std::vector<Eigen::Vector2d>& dots_px);

/// Measures all cells whose intersections are inside `rect` or at most half a spacing outside
/// `rect`. Returns no cells if no paper is visible.
std::vector<SeenCell> measure_cells(const ImageView& scan, const PixelRect& rect,
                                    const TileMap& map, const PrintLevels& levels,
                                    const Code& code);

/// Returns the darkness at a point, interpolated linearly between pixels: 0 for paper of grey level
/// `paper`, 1 for black.
double darkness_at(const ImageView& scan, const Eigen::Vector2d& pixel, double paper);

}  // namespace dotpose::calibrate

/// Renders frames that show a single dot, and measures the dot in these frames.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "dotpose/tools/simulate.hpp"
#include "simulate/ink.hpp"

namespace dotpose::simulate_test {

inline double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

/// A page whose only dot is in cell (1000, 2000).
inline constexpr Cell kDotCell{1000, 2000};
inline Page one_dot_page() {
    Page page;
    page.origin = kDotCell;
    page.columns = 1;
    page.rows = 1;
    return page;
}

/// Returns the offset of the dot's centre from the pose point, computed only from the definitions
/// of code.hpp.
inline Vec2 dot_offset_mm(const Page& page, const CameraPose& pose) {
    const Symbol symbol = symbol_at(page.pattern.code, kDotCell, page.pattern.section);
    const double cells_x = static_cast<double>(kDotCell.x) - pose.cell.x - pose.fraction_x;
    const double cells_y = static_cast<double>(kDotCell.y) - pose.cell.y - pose.fraction_y;
    return {cells_x * page.pattern.spacing_mm + dx(symbol) * page.pattern.displacement_mm,
            cells_y * page.pattern.spacing_mm + dy(symbol) * page.pattern.displacement_mm};
}

/// Returns the grey levels before noise and rounding.
inline std::vector<float> exact_levels(const Page& page, const CameraModel& camera,
                                       const CameraPose& pose, const Imperfections& seen) {
    const simulate::View view(camera, pose, seen);
    simulate::Ink ink;
    add_dots(ink, view, page, seen, simulate::code_of(page.pattern));
    return expose(ink, view, page, seen);
}

/// The light that the ink removes, relative to bare paper.
struct Darkness {
    double mass = 0;  ///< sum over pixels of (paper - level) / paper
    Vec2 centroid_px;
    double variance_u = 0;
    double variance_v = 0;
};

template <typename Levels>
Darkness measure(const Levels& levels, int width_px, double paper) {
    Darkness found;
    double sum_u = 0;
    double sum_v = 0;
    double square_u = 0;
    double square_v = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const double dark = 1 - static_cast<double>(levels[i]) / paper;
        // Ignores small values. Rounding to single precision causes errors of 1e-6 in every pixel,
        // which would add up over the frame.
        if (std::abs(dark) < 1e-5) continue;
        const double u = static_cast<double>(i % static_cast<std::size_t>(width_px));
        const double v = static_cast<double>(i / static_cast<std::size_t>(width_px));
        found.mass += dark;
        sum_u += dark * u;
        sum_v += dark * v;
        square_u += dark * u * u;
        square_v += dark * v * v;
    }
    found.centroid_px = {sum_u / found.mass, sum_v / found.mass};
    found.variance_u = square_u / found.mass - found.centroid_px.x * found.centroid_px.x;
    found.variance_v = square_v / found.mass - found.centroid_px.y * found.centroid_px.y;
    return found;
}

inline double distance(Vec2 a, Vec2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace dotpose::simulate_test

#include "dot_places.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dotpose::roundtrip {
namespace {

struct Point {
    double x = 0;
    double y = 0;
};

/// Returns the centroid of the ink around an intersection. The window includes all ink of the dot
/// and none of its neighbours, because a dot ends 0.25 spacings from its intersection and its
/// neighbours begin at 0.75 spacings.
std::optional<Point> centroid_px(const GreyPage& page, Point centre, double half_px) {
    double ink = 0;
    Point sum;
    for (int v = static_cast<int>(std::ceil(centre.y - half_px - 0.5));
         v + 0.5 <= centre.y + half_px; ++v) {
        for (int u = static_cast<int>(std::ceil(centre.x - half_px - 0.5));
             u + 0.5 <= centre.x + half_px; ++u) {
            if (u < 0 || v < 0 || u >= page.width_px || v >= page.height_px) continue;
            const double weight = 255 - page.at(u, v);
            ink += weight;
            sum.x += weight * (u + 0.5);
            sum.y += weight * (v + 0.5);
        }
    }
    if (ink == 0) return std::nullopt;
    return Point{sum.x / ink, sum.y / ink};
}

Symbol nearest_symbol(Point from_intersection) {
    Symbol best = Symbol::up;
    double best_dot = -1e9;
    for (const Symbol symbol : {Symbol::up, Symbol::left, Symbol::right, Symbol::down}) {
        const double dot = dx(symbol) * from_intersection.x + dy(symbol) * from_intersection.y;
        if (dot > best_dot) {
            best_dot = dot;
            best = symbol;
        }
    }
    return best;
}

}  // namespace

DotErrors measure_dots(const GreyPage& page, const Sheet& sheet, double dpi) {
    const Pattern& pattern = sheet.pattern;
    const double px_per_mm = dpi / 25.4;
    const double um_per_px = 25'400 / dpi;
    DotErrors result;
    Point offset;
    // The second pass shifts the windows by the mean offset found in the first pass.
    for (int pass = 0; pass < 2; ++pass) {
        std::vector<Point> errors;
        result = DotErrors{};
        for (int j = 0; j < sheet.rows; ++j) {
            for (int i = 0; i < sheet.columns; ++i) {
                const Point intersection = {
                    (sheet.origin_x_mm + i * pattern.spacing_mm) * px_per_mm + offset.x,
                    (sheet.origin_y_mm + j * pattern.spacing_mm) * px_per_mm + offset.y};
                const auto found =
                    centroid_px(page, intersection, 0.5 * pattern.spacing_mm * px_per_mm);
                ++result.dots;
                if (!found) {
                    ++result.missing;
                    continue;
                }
                const Cell cell = {sheet.origin.x + static_cast<std::uint32_t>(i),
                                   sheet.origin.y + static_cast<std::uint32_t>(j)};
                const Symbol symbol = symbol_at(pattern.code, cell, pattern.section);
                const Point from = {found->x - intersection.x, found->y - intersection.y};
                if (nearest_symbol(from) != symbol) ++result.wrong_symbols;
                const double displacement_px = pattern.displacement_mm * px_per_mm;
                errors.push_back({offset.x + from.x - dx(symbol) * displacement_px,
                                  offset.y + from.y - dy(symbol) * displacement_px});
            }
        }
        offset = {};
        for (const Point& error : errors) {
            offset.x += error.x / static_cast<double>(errors.size());
            offset.y += error.y / static_cast<double>(errors.size());
        }
        for (const Point& error : errors) {
            const double um = std::hypot(error.x - offset.x, error.y - offset.y) * um_per_px;
            result.mean_um += um / static_cast<double>(errors.size());
            result.largest_um = std::max(result.largest_um, um);
        }
        result.offset_x_um = offset.x * um_per_px;
        result.offset_y_um = offset.y * um_per_px;
    }
    return result;
}

}  // namespace dotpose::roundtrip

// Generates views that are only partly covered by the pattern: edges of sheets, and islands of
// pattern.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

/// Returns the page positions, in spacings, of a regular grid of image points.
std::vector<Vec2> sample_points(const Shot& shot) {
    constexpr int kColumns = 64;
    constexpr int kRows = 48;
    const Projection projection(shot.camera, shot.pose);
    std::vector<Vec2> points;
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const Vec2 offset_mm = projection.offset_from_pixel(
                {(column + 0.5) / kColumns * shot.camera.width_px - 0.5,
                 (row + 0.5) / kRows * shot.camera.height_px - 0.5});
            points.push_back({x_grid(shot.pose) + offset_mm.x / shot.page.pattern.spacing_mm,
                              y_grid(shot.pose) + offset_mm.y / shot.page.pattern.spacing_mm});
        }
    }
    return points;
}

double fraction_in(const PageArea& area, const std::vector<Vec2>& points) {
    const auto inside = std::count_if(points.begin(), points.end(),
                                      [&](Vec2 p) { return area.distance(p.x, p.y) <= 0; });
    return static_cast<double>(inside) / static_cast<double>(points.size());
}

double spacing_px(const Shot& shot) {
    return shot.page.pattern.spacing_mm / shot.camera.mm_per_px;
}

double intersections(const Shot& shot) {
    return shot.camera.width_px * shot.camera.height_px / (spacing_px(shot) * spacing_px(shot));
}

/// Returns a random direction, in rad, that is parallel to an axis of the pattern or of the image.
double draw_direction(const Shot& shot, Rng& rng) {
    const double of_image = rng.uniform() < 0.5 ? shot.pose.theta_rad : 0;
    return of_image + static_cast<double>(rng.below(4)) * std::numbers::pi / 2;
}

/// Returns half the side length, in spacings, of a square so large that at most one of its corners
/// is in view.
double endless(const Shot& shot) {
    return 8 * std::hypot(shot.camera.width_px, shot.camera.height_px) / spacing_px(shot);
}

/// Returns a random sheet whose edge or corner is in view. `fraction` is the fraction of the view
/// that the sheet covers.
PageArea edge_of_sheet(const Shot& shot, double fraction, Rng& rng) {
    const std::vector<Vec2> points = sample_points(shot);
    const double size = endless(shot);
    PageArea area;
    area.half_width = area.half_height = size;
    area.angle_rad = draw_direction(shot, rng);
    const bool is_corner = rng.uniform() < 0.5;
    const Vec2 along{std::cos(area.angle_rad), std::sin(area.angle_rad)};
    // The corner moves into the view along a line near the diagonal of the square.
    const double across = is_corner ? rng.uniform(0.6, 1.0) : 0;
    const auto advance = [&](double by) {
        // Places the square so that its edge is `by` spacings beyond the image centre. For a
        // corner, the adjacent edge is `across * by` spacings beyond the centre.
        const double u = by - size;
        const double v = is_corner ? across * by - size : 0;
        area.x_grid = x_grid(shot.pose) + u * along.x - v * along.y;
        area.y_grid = y_grid(shot.pose) + u * along.y + v * along.x;
    };
    double low = -size;
    double high = size;
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = (low + high) / 2;
        advance(middle);
        (fraction_in(area, points) < fraction ? low : high) = middle;
    }
    return area;
}

/// Returns a random rectangular island of pattern that contains enough dots. Its centre is far
/// enough from the border of the image that most of the rectangle is in view. The caller checks
/// that the whole rectangle is in view.
PageArea draw_island(const Shot& shot, Rng& rng) {
    constexpr double kMinDots = PartialView::kMinIslandDots * 1.05;
    PageArea area;
    const double width = rng.uniform(7, 12);
    area.half_width = width / 2;
    area.half_height = std::max(rng.uniform(7, 12), kMinDots / width) / 2;
    area.angle_rad = draw_direction(shot, rng);
    const Projection projection(shot.camera, shot.pose);
    const double reach_px = 0.75 * spacing_px(shot) * std::hypot(area.half_width, area.half_height);
    const Vec2 offset_mm =
        projection.offset_from_pixel({rng.uniform(reach_px, shot.camera.width_px - reach_px),
                                      rng.uniform(reach_px, shot.camera.height_px - reach_px)});
    area.x_grid = x_grid(shot.pose) + offset_mm.x / shot.page.pattern.spacing_mm;
    area.y_grid = y_grid(shot.pose) + offset_mm.y / shot.page.pattern.spacing_mm;
    return area;
}

/// Returns true if two areas are at least about two spacings apart. Approximates the area `a` by a
/// circle whose radius is 0.85 times half the diagonal of the area.
bool are_apart(const PageArea& a, const PageArea& b) {
    constexpr double kGap = 2;
    const double reach = std::hypot(a.half_width, a.half_height);
    return b.distance(a.x_grid, a.y_grid) > 0.85 * reach + kGap;
}

bool draw_islands(const Shot& shot, int count, Rng& rng, std::vector<PageArea>& areas) {
    constexpr int kTries = 1000;
    areas.clear();
    for (int tries = 0; tries < kTries && static_cast<int>(areas.size()) < count; ++tries) {
        const PageArea island = draw_island(shot, rng);
        const double fraction = fraction_in(island, sample_points(shot));
        const bool is_whole =
            fraction * intersections(shot) >= 0.97 * 4 * island.half_width * island.half_height;
        if (is_whole && std::all_of(areas.begin(), areas.end(), [&](const PageArea& other) {
                return are_apart(island, other);
            }))
            areas.push_back(island);
    }
    return static_cast<int>(areas.size()) == count;
}

}  // namespace

void cover_partly(Shot& shot, const PartialView& view) {
    if (!(view.min_fraction > 0 && view.min_fraction <= view.max_fraction &&
          view.max_fraction <= 1))
        throw BadArgument("the covered fraction must be above 0 and at most 1");
    if (view.islands < 0 || view.islands > 16) throw BadArgument("islands must be 0 to 16");
    Rng rng(shot.seed, 2);
    if (view.islands > 0) {
        for (int tries = 0; !draw_islands(shot, view.islands, rng, shot.page.areas); ++tries) {
            if (tries == 10) throw BadArgument("there is no room for the islands in the image");
        }
        return;
    }
    // At the border of the sheet, some dots are only partly visible. The visible part of the sheet
    // must therefore contain at least 1.15 times `min_dots` dots.
    const double min_fraction =
        std::max(view.min_fraction, 1.15 * view.min_dots / intersections(shot));
    const double fraction = rng.uniform(min_fraction, std::max(min_fraction, view.max_fraction));
    const PageArea dots = edge_of_sheet(shot, fraction, rng);
    shot.page.areas = {dots};
    if (!view.on_table) return;
    PageArea paper = dots;
    const double margin = rng.uniform(0, 4);
    paper.half_width += margin;
    paper.half_height += margin;
    shot.page.paper = paper;
    shot.page.table_reflectance = rng.uniform(0.1, 0.5);
}

}  // namespace dotpose

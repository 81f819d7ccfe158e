#include "core/lattice/grow.hpp"

#include "core/cell_fit.hpp"
#include "core/cells.hpp"
#include "core/lattice/axes.hpp"
#include "core/lattice/regularity.hpp"

namespace dotpose::core {
namespace {

/// Whether |a| <= limit, in both components.
bool is_within(Vec a, std::int32_t limit) {
    const auto twice = static_cast<std::uint32_t>(2 * limit);
    return static_cast<std::uint32_t>(a.x + limit) <= twice &&
           static_cast<std::uint32_t>(a.y + limit) <= twice;
}

/// Shows the dots within reach to `use(p, grid_point)`, which says whether they count as near an
/// intersection.
template <typename Use>
Regularity look_at(std::span<const Dot> dots, int reach_cells, const PlaneFromImage& plane,
                   Use use) {
    constexpr int kFarthest_cells = 500;
    const Cells cells(plane);
    Regularity found;
    for (const Dot& dot : dots) {
        const Vec p = cells.from_centre_q3(dot.centre_q8);
        const GridPoint g = cells(p);
        if (!is_within(g.cell, found.farthest_cell)) {
            const int distance = larger_component(g.cell);
            if (distance > kFarthest_cells) continue;
            found.farthest_cell = distance;
        }
        if (!is_within(g.cell, reach_cells)) continue;
        ++found.dots;
        found.near_intersections += use(p, g);
    }
    return found;
}

/// Whether the dots sit on a grid, and displaced.
Status judge(std::span<const Dot> dots, int reach_cells, const LatticeOptions& options,
             const PlaneFromImage& plane) {
    std::int32_t squared_offsets_q14 = 0;
    const Regularity found = look_at(dots, reach_cells, plane, [&](const Vec&, const GridPoint& g) {
        const Vec offset_q8{g.offset_q16.x >> 8, g.offset_q16.y >> 8};
        squared_offsets_q14 += (offset_q8.x * offset_q8.x + offset_q8.y * offset_q8.y) >> 2;
        return is_within(g.offset_q16, options.max_offset_q16);
    });
    return found.verdict(squared_offsets_q14 / std::max(found.dots, 1) * 64);
}

}  // namespace

Status grow_grid(std::span<const Dot> dots, const LatticeOptions& options, Vec image_centre_q8,
                 const Lattice& first, PlaneFromImage& plane) {
    plane = plane_from_lattice(first, image_centre_q8);
    Regularity found;
    const std::int32_t max_offset_q16 = options.max_offset_q16;
    constexpr int kMostRounds = 3;
    const auto fit = [&](int reach_cells) {
        CellFit sums;
        found = look_at(dots, reach_cells, plane, [&](const Vec& p, const GridPoint& g) {
            if (!is_within(g.offset_q16, max_offset_q16)) return false;
            sums.add(p, g.cell);
            return true;
        });
        return sums.solve(0, plane) && is_nearly_square(plane);
    };
    if (!fit_outwards(kMostRounds, found, fit)) return Status::no_grid;
    return judge(dots, found.farthest_cell, options, plane);
}

}  // namespace dotpose::core

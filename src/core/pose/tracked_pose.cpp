#include "core/pose/tracked_pose.hpp"

#include <array>

#include "core/cell_fit.hpp"
#include "core/fixed.hpp"
#include "core/lattice/coded_cells.hpp"
#include "core/lattice/predicted.hpp"

namespace dotpose::core {

int fit_tracked_pose(std::span<const Dot> dots, Tracking& tracking,
                     PlaneFromImage& pattern_from_image, std::int32_t& displacement_q16) {
    if (dots.empty()) return 0;
    const auto count = static_cast<std::int32_t>(dots.size());
    const std::int32_t displacement_q12 = tracking.projections_q12 / (2 * count);
    displacement_q16 = displacement_q12 * 16;
    set_displacement(displacement_q12, tracking);
    // Where dots were printed, in 1/64 cells.
    constexpr int kTargetBits = 6;
    const std::int32_t displaced = (displacement_q12 + 32) >> (12 - kTargetBits);
    std::array<Vec, 4> targets;
    for (std::size_t s = 0; s < targets.size(); ++s) {
        const auto symbol = static_cast<Symbol>(s);
        targets[s] = {dx(symbol) * displaced, dy(symbol) * displaced};
    }
    // Printers and lenses rarely move a dot by so much, an eighth of the spacing; dirt does.
    const std::int32_t far_q8 = tracking.spacing_q8 / 8;
    const Vec centre_q8{(tracking.width_px - 1) * 128, (tracking.height_px - 1) * 128};
    CellFit fit;
    const std::uint16_t* cell = tracking.dot_cells.data();
    for (const Dot& dot : dots) {
        const int i = *cell % kMostTracked;
        const int j = *cell++ / kMostTracked;
        const auto symbol = static_cast<std::size_t>(coded_symbol(tracking, i, j));
        const Vec place = place_q16(tracking.cells, i, j) + tracking.displaced_q16[symbol];
        if (!is_within(dot.centre_q8 - Vec{place.x >> 8, place.y >> 8}, far_q8)) continue;
        // In 1/8 px, rounded.
        const Vec p = dot.centre_q8 - centre_q8 + Vec{16, 16};
        fit.add({p.x >> 5, p.y >> 5},
                Vec{i * (1 << kTargetBits), j * (1 << kTargetBits)} + targets[symbol]);
    }
    pattern_from_image = {};
    pattern_from_image.centre_q8 = centre_q8;
    return fit.solve(kTargetBits, pattern_from_image) ? fit.count() : 0;
}

}  // namespace dotpose::core

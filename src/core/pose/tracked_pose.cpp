#include "core/pose/tracked_pose.hpp"

#include <algorithm>
#include <array>

#include "core/by_itself.hpp"
#include "core/cell_fit.hpp"
#include "core/fixed.hpp"
#include "core/lattice/coded_cells.hpp"

namespace dotpose::core {

namespace {

DOTPOSE_BY_ITSELF void add(CellFit& fit, Vec p, Vec target) {
    fit.add(p, target);
}

}  // namespace

int fit_tracked_pose(std::span<const Dot> dots, const Tracking& tracking,
                     PlaneFromImage& pattern_from_image, std::int32_t& displacement_q16) {
    if (dots.empty()) return 0;
    const auto count = static_cast<std::int32_t>(dots.size());
    // By so much of itself the mean displacement is longer than was expected, in 2^-12.
    const Vec up_q16 = tracking.displaced_q16[static_cast<std::size_t>(Symbol::up)];
    const Vec up_q8{up_q16.x >> 8, up_q16.y >> 8};
    const std::int32_t squared_q16 = up_q8.x * up_q8.x + up_q8.y * up_q8.y;
    const std::int32_t longer_q12 = tracking.along_q16 / count * 64 / std::max(squared_q16 / 64, 1);
    const std::int32_t displacement_q12 =
        tracking.displacement_q12 + ((tracking.displacement_q12 * longer_q12) >> 12);
    displacement_q16 = displacement_q12 * 16;
    // Where dots were printed, in 1/64 cells.
    constexpr int kTargetBits = 6;
    const std::int32_t displaced = (displacement_q12 + 32) >> (12 - kTargetBits);
    std::array<Vec, 4> targets;
    for (std::size_t s = 0; s < targets.size(); ++s) {
        const auto symbol = static_cast<Symbol>(s);
        targets[s] = {dx(symbol) * displaced, dy(symbol) * displaced};
    }
    const Vec centre_q8{(tracking.width_px - 1) * 128, (tracking.height_px - 1) * 128};
    CellFit fit;
    const std::uint16_t* cell = tracking.dot_cells.data();
    for (const Dot& dot : dots) {
        const int i = *cell % kMostTracked;
        const int j = *cell++ / kMostTracked;
        const auto symbol = static_cast<std::size_t>(coded_symbol(tracking, i, j));
        // In 1/8 px, rounded.
        const Vec p = dot.centre_q8 - centre_q8 + Vec{16, 16};
        add(fit, {p.x >> 5, p.y >> 5},
            Vec{i * (1 << kTargetBits), j * (1 << kTargetBits)} + targets[symbol]);
    }
    pattern_from_image = {};
    pattern_from_image.centre_q8 = centre_q8;
    return fit.solve(kTargetBits, pattern_from_image) ? fit.count() : 0;
}

}  // namespace dotpose::core

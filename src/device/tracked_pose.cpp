#include "device/tracked_pose.hpp"

#include <algorithm>
#include <bit>

#include "core/math/fixed.hpp"
#include "device/affine_fit_int32.hpp"
#include "device/predicted.hpp"

namespace dotpose::core {
namespace {

/// Returns the right shift, in bits, that reduces the total mass to less than 2^16. The same shift
/// is applied to the masses and to the mass-weighted sums. All sums are then less than 2^31: a dot
/// is at most 16 cells from the middle, and its offset is at most 448/256 px, an eighth of the
/// maximum spacing of 14 px.
int excess_bits(const Tracking& tracking) {
    std::uint32_t mass = 0;
    for (const TrackedRow& row : tracking.grid_rows)
        mass += static_cast<std::uint32_t>(row.mass);
    return std::max(static_cast<int>(std::bit_width(mass)) - 16, 0);
}

/// Returns the sums for a least-squares fit of an affine function to the offsets of dots. The
/// arguments of the function are the cell coordinates. Each dot is weighted by its mass.
AffineFitInt32 fit_of_offsets(const Tracking& tracking, int excess) {
    std::int32_t mass = 0;
    FixedVec cells;
    FixedVec offset_q8;
    AffineFitInt32::Products<std::int32_t> sums;
    for (int j = tracking.first_cell; j <= tracking.last_cell; ++j) {
        const TrackedRow& row = tracking.grid_rows[static_cast<std::size_t>(j)];
        if (row.mass == 0) continue;
        const int from_middle = j - kMiddleCell;
        const std::int32_t mass_here = row.mass >> excess;
        const std::int32_t mass_i = row.mass_i >> excess;
        const FixedVec offset_here{row.offset_q8.x >> excess, row.offset_q8.y >> excess};
        mass += mass_here;
        cells = cells + FixedVec{mass_i, from_middle * mass_here};
        offset_q8 = offset_q8 + offset_here;
        sums.xx += row.mass_ii >> excess;
        sums.xy += from_middle * mass_i;
        sums.yy += from_middle * from_middle * mass_here;
        sums.ix += row.offset_i_q8.x >> excess;
        sums.iy += from_middle * offset_here.x;
        sums.jx += row.offset_i_q8.y >> excess;
        sums.jy += from_middle * offset_here.y;
    }
    return {mass, cells, offset_q8, sums};
}

/// Returns the cell map corrected by the fitted offsets.
CellMap corrected(const CellMap& cells, const PlaneFromImage& offsets) {
    // `AffineFitInt32` expects coordinates in 1/8 px, but these coordinates are whole cells. The
    // slopes are therefore divided by 8.
    constexpr int kShift = 24 + 3 - 16;
    const FixedVec du_q16{offsets.du_q24.x >> kShift, offsets.du_q24.y >> kShift};
    const FixedVec dv_q16{offsets.dv_q24.x >> kShift, offsets.dv_q24.y >> kShift};
    return {cells.origin_q16 + offsets.at_centre_q16 -
                FixedVec{kMiddleCell * (du_q16.x + dv_q16.x), kMiddleCell * (du_q16.y + dv_q16.y)},
            cells.along_x_q16 + du_q16, cells.along_y_q16 + dv_q16};
}

/// Sets the plane to the inverse of the cell map. Returns false if cells are smaller than 1 px^2.
bool invert(const CellMap& cells, FixedVec centre_q8, PlaneFromImage& plane) {
    const FixedVec x = cells.along_x_q16;
    const FixedVec y = cells.along_y_q16;
    const std::int64_t det_q24 = cross(x, y) >> 8;
    // A fit to only a few dots may be arbitrarily wrong, and give very small cells. Such cells are
    // rejected, because the slopes would overflow.
    if (det_q24 < 1 << 24) return false;
    const auto slope_q24 = [&](std::int32_t a_q16) {
        return short_quotient(std::int64_t{a_q16} << 32, det_q24);
    };
    plane = {};
    plane.centre_q8 = centre_q8;
    plane.du_q24 = {slope_q24(y.y), slope_q24(-x.y)};
    plane.dv_q24 = {slope_q24(-y.x), slope_q24(x.x)};
    const FixedVec from_origin_q16{centre_q8.x * 256 - cells.origin_q16.x,
                                   centre_q8.y * 256 - cells.origin_q16.y};
    const auto at_q16 = [&](std::int32_t du_q24, std::int32_t dv_q24) {
        return shift_rounded(
            std::int64_t{du_q24} * from_origin_q16.x + std::int64_t{dv_q24} * from_origin_q16.y,
            24);
    };
    plane.at_centre_q16 = {at_q16(plane.du_q24.x, plane.dv_q24.x),
                           at_q16(plane.du_q24.y, plane.dv_q24.y)};
    return true;
}

/// Returns (measured - expected) / expected for the mean displacement of dots, in units of 2^-12.
/// The expected value is `Tracking::displacement_q12`.
std::int32_t relative_excess_q12(const Tracking& tracking, int excess, std::int32_t mass) {
    std::int64_t along = 0;
    for (std::size_t s = 0; s < tracking.offset_q8.size(); ++s) {
        const FixedVec displaced_q16 = tracking.displaced_q16[s];
        along +=
            dot(FixedVec{displaced_q16.x >> 8, displaced_q16.y >> 8},
                FixedVec{tracking.offset_q8[s].x >> excess, tracking.offset_q8[s].y >> excess});
    }
    const FixedVec up_q16 = tracking.displaced_q16[static_cast<std::size_t>(Symbol::up)];
    const std::int64_t squared_q16 = squared(FixedVec{up_q16.x >> 8, up_q16.y >> 8});
    return scaled_quotient(along, std::max<std::int64_t>(mass * squared_q16, 1), 12);
}

}  // namespace

int fit_tracked_pose(const Tracking& tracking, PlaneFromImage& pattern_from_image,
                     std::int32_t& displacement_q16) {
    const int excess = excess_bits(tracking);
    AffineFitInt32 fit = fit_of_offsets(tracking, excess);
    const std::int32_t length_q12 = tracking.displacement_q12;
    displacement_q16 =
        16 *
        (length_q12 + ((length_q12 * relative_excess_q12(tracking, excess, fit.count())) >> 12));
    PlaneFromImage offsets{};
    const FixedVec centre_q8{(tracking.width_px - 1) * 128, (tracking.height_px - 1) * 128};
    const bool is_determined = fit.solve(8, offsets) && invert(corrected(tracking.cells, offsets),
                                                               centre_q8, pattern_from_image);
    return is_determined ? tracking.dots_measured : 0;
}

}  // namespace dotpose::core

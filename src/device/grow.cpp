#include "device/grow.hpp"

#include <array>

#include "core/lattice/axes.hpp"
#include "core/lattice/regularity.hpp"
#include "core/math/cells.hpp"
#include "core/noinline.hpp"
#include "device/affine_fit_int32.hpp"

namespace dotpose::core {
namespace {

/// The set of vectors whose components are both in [low, low + extent], modulo 2^32.
struct Square {
    std::uint32_t low;
    std::uint32_t extent;

    bool holds(std::uint32_t x, std::uint32_t y) const {
        return x - low <= extent && y - low <= extent;
    }
    bool holds(FixedVec a) const {
        return holds(static_cast<std::uint32_t>(a.x), static_cast<std::uint32_t>(a.y));
    }
};

/// Returns the set of plane points in cells that are at most `limit` cells from cell (0, 0) along
/// each axis. The points are in units of 2^-16 spacings. The cell of a point is its integer part.
Square cells_within(int limit) {
    return {static_cast<std::uint32_t>(-limit * 65536),
            static_cast<std::uint32_t>((2 * limit + 1) * 65536 - 1)};
}

/// Returns the set of offsets whose components are both at most `limit_q16` in magnitude. Offsets
/// are relative to the nearest intersection. Each component is encoded as the lower 16 bits of the
/// same component of `rounding_plane_point_q16`, shifted left by 16 bits.
Square offsets_within(std::int32_t limit_q16) {
    return {static_cast<std::uint32_t>(32768 - limit_q16) << 16,
            static_cast<std::uint32_t>(std::min<std::int32_t>(2 * limit_q16, 65535)) << 16};
}
bool is_near(FixedVec rounding_q16, const Square& offsets) {
    return offsets.holds(static_cast<std::uint32_t>(rounding_q16.x) << 16,
                         static_cast<std::uint32_t>(rounding_q16.y) << 16);
}

/// Maximum distance of a cell from cell (0, 0) along each axis, in cells. Dots in farther cells are
/// ignored.
constexpr int kFarthest_cells = 500;

/// Calls `use(dot, c, is_within_reach)` for each dot. c is the `rounding_plane_point_q16` of the
/// dot, and the integer part of c is the nearest cell. `is_within_reach` is true if this cell is at
/// most `reach_cells` cells from cell (0, 0) along each axis. Returns the statistics of the dots,
/// but does not set `near_intersections`.
template <typename Use>
Regularity visit_cells(std::span<const DetectedDot> dots, int reach_cells, const Cells& cells,
                       Use use) {
    int farthest_cell = 0;
    int beyond = 0;
    const Square reach = cells_within(reach_cells);
    // The cells that are within reach and no farther from cell (0, 0) than the farthest dot so far.
    // Most dots are in these cells and need no further tests.
    Square common = cells_within(0);
    for (const DetectedDot& dot : dots) {
        const FixedVec c = cells.rounding_plane_point_q16(cells.from_centre_q3(dot.centre_q8));
        bool is_within_reach = common.holds(c);
        if (!is_within_reach) {
            const int distance = larger_component({c.x >> 16, c.y >> 16});
            if (distance <= kFarthest_cells && distance > farthest_cell) {
                farthest_cell = distance;
                common = cells_within(std::min(distance, reach_cells));
            }
            is_within_reach = distance <= kFarthest_cells && reach.holds(c);
            if (!is_within_reach) ++beyond;
        }
        use(dot, c, is_within_reach);
    }
    Regularity found;
    found.dots = static_cast<int>(dots.size()) - beyond;
    found.farthest_cell = farthest_cell;
    return found;
}

/// The cell of a dot, packed into one word, or `no` if the fit does not use the dot.
enum class Used : std::uint32_t { no = 0x80808080 };

Used used(FixedVec rounding_q16) {
    return Used{(static_cast<std::uint32_t>(rounding_q16.x) & 0xFFFF0000) |
                static_cast<std::uint32_t>(rounding_q16.y) >> 16};
}
FixedVec cell_of(Used used) {
    const auto both = static_cast<std::uint32_t>(used);
    return {static_cast<std::int16_t>(both >> 16), static_cast<std::int16_t>(both & 0xFFFF)};
}

std::int64_t mean_square_q20(std::int32_t squared_offsets_q14, int dots) {
    return squared_offsets_q14 / std::max(dots, 1) * 64;
}
/// Returns the squared offset of a dot from its intersection, in 2^-14 spacings^2.
std::int32_t squared_offset_q14(FixedVec rounding_q16) {
    const FixedVec offset_q8{(rounding_q16.x >> 8 & 255) - 128, (rounding_q16.y >> 8 & 255) - 128};
    return (offset_q8.x * offset_q8.x + offset_q8.y * offset_q8.y) >> 2;
}

/// Fits the grid several times. Most dots keep their cell from one fit to the next, so each fit
/// updates the sums only for dots whose cell has changed.
class Fits {
  public:
    Fits(std::span<const DetectedDot> dots, std::int32_t max_offset_q16)
        : dots_(dots), near_(offsets_within(max_offset_q16)) {
        if (remembers()) std::fill_n(before_.begin(), dots.size(), Used::no);
    }

    /// Fits a plane to the dots that are within reach and near an intersection of `plane`. Replaces
    /// `plane` with the result. Sets `found` to the statistics of the dots. Returns false if the
    /// dots do not determine the plane, or if its cells are not nearly square.
    bool operator()(int reach_cells, Regularity& found, PlaneFromImage& plane) {
        const Cells cells(plane);
        found = remembers() ? sum_up_changes(reach_cells, cells) : sum_up(reach_cells, cells);
        found.near_intersections = sums_.count();
        return sums_.solve(0, plane) && is_nearly_square(plane);
    }

    /// Checks that the dots are on a grid and displaced from its intersections. Errors: no_grid,
    /// no_displacement.
    Status judge(int reach_cells, const PlaneFromImage& plane) const {
        const Square near = near_;
        std::int32_t squared_offsets_q14 = 0;
        int near_intersections = 0;
        Regularity found = visit_cells(dots_, reach_cells, Cells(plane),
                                       [&](const DetectedDot&, FixedVec c, bool is_within) {
                                           if (!is_within) return;
                                           squared_offsets_q14 += squared_offset_q14(c);
                                           near_intersections += is_near(c, near) ? 1 : 0;
                                       });
        found.near_intersections = near_intersections;
        return found.verdict(mean_square_q20(squared_offsets_q14, found.dots));
    }

  private:
    bool remembers() const { return dots_.size() <= before_.size(); }

    Regularity sum_up(int reach_cells, const Cells& cells) {
        AffineFitInt32 sums;
        const Square near = near_;
        const Regularity found = visit_cells(
            dots_, reach_cells, cells, [&](const DetectedDot& dot, FixedVec c, bool is_within) {
                if (!is_within || !is_near(c, near)) return;
                sums.add(cells.from_centre_q3(dot.centre_q8), {c.x >> 16, c.y >> 16});
            });
        sums_ = sums;
        return found;
    }
    Regularity sum_up_changes(int reach_cells, const Cells& cells) {
        Used* before = before_.data();
        const Square near = near_;
        return visit_cells(dots_, reach_cells, cells,
                           [&](const DetectedDot& dot, FixedVec c, bool is_within) {
                               const Used now = is_within && is_near(c, near) ? used(c) : Used::no;
                               if (now != *before) {
                                   const FixedVec p = cells.from_centre_q3(dot.centre_q8);
                                   if (*before != Used::no) count(p, *before, -1);
                                   if (now != Used::no) count(p, now, 1);
                                   *before = now;
                               }
                               ++before;
                           });
    }
    DOTPOSE_NOINLINE void count(FixedVec p, Used used, int weight) {
        sums_.count(p, cell_of(used), weight);
    }

    std::span<const DetectedDot> dots_;
    Square near_;
    AffineFitInt32 sums_;
    /// Cell of each dot in the previous fit. If there are more dots than elements, the array is not
    /// used, and each fit recomputes the sums over all dots.
    std::array<Used, 384> before_;
};

}  // namespace

Status grow_grid(std::span<const DetectedDot> dots, const LatticeOptions& options,
                 FixedVec image_centre_q8, const Lattice& first, PlaneFromImage& plane) {
    plane = plane_from_lattice(first, image_centre_q8);
    Fits fits(dots, options.max_offset_q16);
    Regularity found;
    constexpr int kMaxRounds = 3;
    const auto fit = [&](int reach_cells) { return fits(reach_cells, found, plane); };
    if (!fit_outwards(kMaxRounds, found, fit)) return Status::no_grid;
    return fits.judge(found.farthest_cell, plane);
}

}  // namespace dotpose::core

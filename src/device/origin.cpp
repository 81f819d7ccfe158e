#include "device/origin.hpp"

#include "core/math/cells.hpp"

namespace dotpose::core {
namespace {

/// Maximum distance between `near_q8` and the dots that determine the origin, in cells along each
/// axis. At larger distances, positions computed from the first grid may be off by a third of a
/// cell.
constexpr int kReach_cells = 4;

/// Circular mean of dot offsets along one axis: the angle of a sum of unit vectors.
struct Phase {
    FixedVec sum;

    void add(std::int32_t offset_q16) {
        sum = sum + FixedVec{rough_cosine(offset_q16), rough_sine(offset_q16)};
    }
    std::int32_t mean_q16() const { return angle_bam(sum) >> 16; }
};

}  // namespace

void find_origin(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                 FixedVec near_q8, Lattice& lattice) {
    lattice.origin_q16 = {near_q8.x * 256, near_q8.y * 256};
    const Cells cells(plane_from_lattice(lattice, near_q8));
    Phase i;
    Phase j;
    for (const std::uint16_t seed : seeds) {
        const GridPoint g = cells(cells.from_centre_q3(dots[seed].centre_q8));
        if (larger_component(g.cell) > kReach_cells) continue;
        i.add(g.offset_q16.x);
        j.add(g.offset_q16.y);
    }
    const std::int64_t i_q16 = i.mean_q16();
    const std::int64_t j_q16 = j.mean_q16();
    lattice.origin_q16 =
        lattice.origin_q16 +
        FixedVec{shift_rounded(i_q16 * lattice.u_q16.x + j_q16 * lattice.v_q16.x, 16),
                 shift_rounded(i_q16 * lattice.u_q16.y + j_q16 * lattice.v_q16.y, 16)};
}

}  // namespace dotpose::core

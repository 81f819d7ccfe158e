#include "core/lattice/periodogram_search.hpp"

#include <algorithm>
#include <array>

#include "core/lattice/neighbours.hpp"
#include "core/lattice/tuning.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::periodogram_search;

/// A plane wave whose crests are the columns or rows of a grid.
struct Wave {
    std::int32_t direction_bam = 0;
    std::int32_t spacing_q16 = 0;  ///< in 2^-16 px

    /// Returns the wave vector, in units of 2^-30 cycles per px.
    FixedVec vector_q30() const {
        const FixedVec unit = unit_q30(direction_bam);
        return {static_cast<std::int32_t>((std::int64_t{unit.x} << 16) / spacing_q16),
                static_cast<std::int32_t>((std::int64_t{unit.y} << 16) / spacing_q16)};
    }
    Wave turned(std::int32_t angle_bam) const {
        return {static_cast<std::int32_t>(static_cast<std::uint32_t>(direction_bam) +
                                          static_cast<std::uint32_t>(angle_bam)),
                spacing_q16};
    }
};

constexpr std::int32_t kQuarter_bam = 1 << 30;

/// Periodogram of the seeds within `reach_q8` of the centre along each axis.
class Periodogram {
  public:
    Periodogram(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                FixedVec centre_q8, std::int32_t reach_q8) {
        for (const std::uint16_t s : seeds) {
            const FixedVec p = dots[s].centre_q8 - centre_q8;
            if (larger_component(p) <= reach_q8) points_q8_[count_++] = p;
        }
    }

    /// Returns the sums, over all seeds, of the cosine and the sine of the wave's phase.
    FixedVec sum(const Wave& wave) const {
        const FixedVec wave_q30 = wave.vector_q30();
        FixedVec total;
        for (const FixedVec p : std::span(points_q8_).first(count_)) {
            const auto phase_q16 = static_cast<std::int32_t>(dot(wave_q30, p) >> 22);
            total.x += rough_cosine(phase_q16);
            total.y += rough_sine(phase_q16);
        }
        return total;
    }

    std::int64_t power(const Wave& wave) const { return squared(sum(wave)); }
    /// Returns the total power of the wave and the perpendicular wave.
    std::int64_t power_of_square(const Wave& wave) const {
        return power(wave) + power(wave.turned(kQuarter_bam));
    }

  private:
    std::array<FixedVec, kMaxSeeds> points_q8_;  ///< relative to the centre
    std::size_t count_ = 0;
};

constexpr std::int32_t kDegree_bam = 11930465;

/// A raster around a given wave: the step sizes in direction and spacing, and the number of steps
/// to each side.
struct Raster {
    std::int32_t turn_bam;
    std::int32_t stretch_q16;
    int turns;
    int stretches;
};

/// Returns the strongest wave in a raster centred on the wave `around`.
template <typename Power>
Wave best_around(const Wave& around, const Raster& raster, Power power) {
    Wave best = around;
    std::int64_t max_power = -1;
    for (int t = -raster.turns; t <= raster.turns; ++t) {
        for (int s = -raster.stretches; s <= raster.stretches; ++s) {
            Wave wave = around.turned(t * raster.turn_bam);
            wave.spacing_q16 += s * raster.stretch_q16;
            const std::int64_t here = power(wave);
            if (here > max_power) {
                max_power = here;
                best = wave;
            }
        }
    }
    return best;
}

/// Returns a local maximum of the power near `wave`. Searches rasters with decreasing step sizes.
template <typename Power>
Wave ascend(Wave wave, Power power) {
    const std::int32_t spacing_q16 = wave.spacing_q16;
    for (int fineness = 1; fineness <= tuned::kFinest; fineness *= 2) {
        wave = best_around(wave,
                           {tuned::kFirstTurn_deg * kDegree_bam / fineness,
                            spacing_q16 / tuned::kFirstStretchPart / fineness, 1, 1},
                           power);
    }
    return wave;
}

/// Returns the lattice whose columns are the crests of `first` and whose rows are the crests of
/// `second`. The lattice origin is near the centre.
Lattice lattice_of(const Periodogram& periodogram, const Wave& first, const Wave& second,
                   FixedVec centre_q8) {
    const FixedVec a = first.vector_q30();
    const FixedVec b = second.vector_q30();
    const std::int64_t area_q44 = std::max<std::int64_t>(cross(a, b) >> 16, 1);
    // Limit on the axis components, in 2^-16 px, to prevent an overflow if both waves have the same
    // direction. The caller rejects such a lattice later.
    constexpr std::int32_t kLongest_q16 = 4096 << 16;
    const auto entry = [&](std::int32_t part_q30) {
        return limited((std::int64_t{part_q30} << 30) / area_q44, kLongest_q16);
    };
    Lattice lattice;
    lattice.u_q16 = {entry(b.y), entry(-b.x)};
    lattice.v_q16 = {entry(-a.y), entry(a.x)};
    // At an intersection, the phase of each wave equals the angle of its `Periodogram::sum`, modulo
    // one cycle.
    const std::int64_t i_q16 = angle_bam(periodogram.sum(first)) >> 16;
    const std::int64_t j_q16 = angle_bam(periodogram.sum(second)) >> 16;
    lattice.origin_q16 = {
        centre_q8.x * 256 + shift_rounded(i_q16 * lattice.u_q16.x + j_q16 * lattice.v_q16.x, 16),
        centre_q8.y * 256 + shift_rounded(i_q16 * lattice.u_q16.y + j_q16 * lattice.v_q16.y, 16)};
    return lattice;
}

}  // namespace

void search_periodogram(std::span<const DetectedDot> dots, std::span<const std::uint16_t> seeds,
                        FixedVec centre_q8, int max_turn_deg, Lattice& lattice) {
    const std::uint32_t length_q16 = square_root(
        static_cast<std::uint64_t>(squared(lattice.u_q16) / 2 + squared(lattice.v_q16) / 2));
    Wave wave{angle_bam({lattice.u_q16.x / 2 + lattice.v_q16.y / 2,
                         lattice.u_q16.y / 2 - lattice.v_q16.x / 2}),
              static_cast<std::int32_t>(length_q16)};
    // Uses only the dots within kNear_cells of the centre, because their periodogram has a peak
    // that is wide enough for a coarse raster.
    const Periodogram near(dots, seeds, centre_q8, wave.spacing_q16 / 256 * tuned::kNear_cells);
    wave = best_around(wave,
                       {tuned::kTurn_deg * kDegree_bam, wave.spacing_q16 / tuned::kStretchPart,
                        max_turn_deg / tuned::kTurn_deg, tuned::kStretches},
                       [&](const Wave& w) { return near.power_of_square(w); });
    // Searches for each direction separately. If the camera is tilted, the two directions have
    // different spacings and are not perpendicular.
    const Raster tilt{tuned::kTiltTurn_deg * kDegree_bam,
                      wave.spacing_q16 / tuned::kTiltStretchPart, tuned::kTiltSteps,
                      tuned::kTiltSteps};
    const auto near_power = [&](const Wave& w) { return near.power(w); };
    Wave first = best_around(wave, tilt, near_power);
    Wave second = best_around(wave.turned(kQuarter_bam), tilt, near_power);
    const Periodogram wider(dots, seeds, centre_q8, wave.spacing_q16 / 256 * tuned::kWider_cells);
    const auto wider_power = [&](const Wave& w) { return wider.power(w); };
    first = ascend(first, wider_power);
    second = ascend(second, wider_power);
    lattice = lattice_of(wider, first, second, centre_q8);
}

}  // namespace dotpose::core

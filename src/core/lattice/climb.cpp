#include "core/lattice/climb.hpp"

#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

/// A sine to 6 %: two parabolas. Phases are in 2^-16 turns, values times 2^14.
std::int32_t rough_sine(std::int32_t phase_q16) {
    const std::int32_t x = static_cast<std::int16_t>(phase_q16 & 0xFFFF);
    return x * (32768 - (x < 0 ? -x : x)) >> 14;
}
std::int32_t rough_cosine(std::int32_t phase_q16) {
    return rough_sine(phase_q16 + 16384);
}

/// A square grid: its wave vector, in turns per px, as direction and spacing.
struct Square {
    std::int32_t direction_bam = 0;
    std::int32_t spacing_q16 = 0;  ///< px

    Vec wave_q30() const {
        const Vec unit = unit_q30(direction_bam);
        return {static_cast<std::int32_t>((std::int64_t{unit.x} << 16) / spacing_q16),
                static_cast<std::int32_t>((std::int64_t{unit.y} << 16) / spacing_q16)};
    }
};

/// Sums of the waves over the dots near the centre.
class Periodogram {
  public:
    Periodogram(std::span<const Dot> dots, std::span<const std::uint16_t> seeds, Vec centre_q8)
        : dots_(dots), seeds_(seeds), centre_q8_(centre_q8) {}

    void set_reach(std::int32_t reach_q8) { reach_q8_ = reach_q8; }

    Vec sum(Vec wave_q30) const {
        Vec total;
        for (const std::uint16_t s : seeds_) {
            const Vec p = dots_[s].centre_q8 - centre_q8_;
            if (std::max({p.x, -p.x, p.y, -p.y}) > reach_q8_) continue;
            const auto phase_q16 = static_cast<std::int32_t>(dot(wave_q30, p) >> 22);
            total.x += rough_cosine(phase_q16);
            total.y += rough_sine(phase_q16);
        }
        return total;
    }

    std::int64_t power(const Square& square) const {
        const Vec wave = square.wave_q30();
        return squared(sum(wave)) + squared(sum({-wave.y, wave.x}));
    }

  private:
    std::span<const Dot> dots_;
    std::span<const std::uint16_t> seeds_;
    Vec centre_q8_;
    std::int32_t reach_q8_ = INT32_MAX;
};

constexpr std::int32_t kDegree_bam = 11930465;

/// The best of a raster of directions and spacings around a square.
Square best_around(const Periodogram& periodogram, Square around, std::int32_t turn_bam,
                   std::int32_t stretch_q16, int turns, int stretches) {
    Square best = around;
    std::int64_t most = -1;
    for (int t = -turns; t <= turns; ++t) {
        for (int s = -stretches; s <= stretches; ++s) {
            const Square square{
                static_cast<std::int32_t>(static_cast<std::uint32_t>(around.direction_bam) +
                                          static_cast<std::uint32_t>(t * turn_bam)),
                around.spacing_q16 + s * stretch_q16};
            const std::int64_t power = periodogram.power(square);
            if (power > most) {
                most = power;
                best = square;
            }
        }
    }
    return best;
}

}  // namespace

void climb_periodogram(std::span<const Dot> dots, std::span<const std::uint16_t> seeds,
                       Vec centre_q8, Lattice& lattice) {
    const std::uint32_t length_q16 = square_root(
        static_cast<std::uint64_t>(squared(lattice.u_q16) / 2 + squared(lattice.v_q16) / 2));
    Square square{angle_bam({lattice.u_q16.x / 2 + lattice.v_q16.y / 2,
                             lattice.u_q16.y / 2 - lattice.v_q16.x / 2}),
                  static_cast<std::int32_t>(length_q16)};
    Periodogram periodogram(dots, seeds, centre_q8);
    // A few cells wide, the peak is broad enough for a coarse raster to meet it.
    periodogram.set_reach(square.spacing_q16 / 256 * 5);
    square = best_around(periodogram, square, 2 * kDegree_bam, square.spacing_q16 / 40, 6, 4);
    periodogram.set_reach(square.spacing_q16 / 256 * 8);
    for (int fineness = 1; fineness <= 8; fineness *= 2) {
        square = best_around(periodogram, square, kDegree_bam / fineness,
                             square.spacing_q16 / 80 / fineness, 1, 1);
    }

    const Vec unit = unit_q30(square.direction_bam);
    const auto along = [&](std::int32_t part_q30) {
        return static_cast<std::int32_t>((std::int64_t{part_q30} * square.spacing_q16) >> 30);
    };
    lattice.u_q16 = {along(unit.x), along(unit.y)};
    lattice.v_q16 = {-lattice.u_q16.y, lattice.u_q16.x};
    // Dots stand at whole turns of both waves, but for the phase that their sum shows.
    const Vec wave = square.wave_q30();
    const std::int64_t i_q16 = angle_bam(periodogram.sum(wave)) >> 16;
    const std::int64_t j_q16 = angle_bam(periodogram.sum({-wave.y, wave.x})) >> 16;
    lattice.origin_q16 = {
        centre_q8.x * 256 + shift_rounded(i_q16 * lattice.u_q16.x + j_q16 * lattice.v_q16.x, 16),
        centre_q8.y * 256 + shift_rounded(i_q16 * lattice.u_q16.y + j_q16 * lattice.v_q16.y, 16)};
}

}  // namespace dotpose::core

#include <array>
#include <cmath>
#include <cstdlib>

#include "core/decode/nominal.hpp"
#include "core/decode/position.hpp"
#include "core/decode/upright.hpp"
#include "core/decode/window.hpp"
#include "core/integrity/confidence.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"
#include "integrity.hpp"

namespace dotpose::tables {
namespace {

constexpr int kMaxSide = 16;

/// A grid of bits, as if read from a pattern, and its true position.
struct Reading {
    std::array<GridCell, kMaxSide * kMaxSide> cells;
    core::Grid grid;
    CodeVariant code = CodeVariant::anoto;
    QuarterTurn turn;
    Place place;  ///< true position of grid cell (0, 0)
};

/// Returns the grid cell that `core::turned` converts to the bits `x` and `y`.
GridCell cell_of(QuarterTurn turn, int x, int y) {
    const FixedVec grid = turn.quarters == 1   ? FixedVec{-y, x}
                          : turn.quarters == 3 ? FixedVec{y, -x}
                          : turn.quarters == 2 ? FixedVec{-x, -y}
                                               : FixedVec{x, y};
    return {static_cast<std::int8_t>(grid.x), static_cast<std::int8_t>(grid.y), 0};
}

/// Parameters of the random errors in a simulated reading.
struct Noise {
    double odds_log2;  ///< log2 of the odds that a bit of weight 127 is correct
    double missing;    ///< fraction of the cells without a dot
    int min_weight;

    double chance_of_error(int weight) const {
        return 1 / (1 + std::exp2(odds_log2 * weight / 127));
    }
    int read(int bit, Rng& rng) const {
        const int range = 127 - min_weight + 1;
        const int weight = min_weight + static_cast<int>(rng.below(static_cast<unsigned>(range)));
        const bool is_wrong = rng.uniform() < chance_of_error(weight);
        return (bit == 1) != is_wrong ? weight : -weight;
    }
    /// Returns the information in a bit with this weight: 1 - H(probability of an error), in bits,
    /// where H is the binary entropy function.
    double information(int weight) const {
        const double q = chance_of_error(weight);
        return 1 + q * std::log2(q) + (1 - q) * std::log2(1 - q);
    }
    /// Returns the expected information per cell bit, in bits, averaged over all weights. Missing
    /// cells contain no information.
    double information() const {
        double sum = 0;
        for (int weight = min_weight; weight <= 127; ++weight)
            sum += information(weight);
        return (1 - missing) * sum / (127 - min_weight + 1);
    }
};

/// Draws a random `odds_log2` at which a reading of `cells` cells is doubtful. There are 2^36.6
/// combinations of position, section and turn along one axis, so the decoder needs 36.6 bits of
/// information to distinguish them. It needs about 30 more bits to make a wrong position unlikely.
/// The information in the reading is therefore drawn uniformly from 60 to 80 bits.
double draw_odds_of_doubt(double cells, Noise noise, Rng& rng) {
    const double wanted_bits = rng.uniform(60, 80);
    constexpr double kMaxOdds_log2 = 12;
    noise.odds_log2 = 0;
    for (double step = kMaxOdds_log2 / 2; step > 0.01; step /= 2) {
        noise.odds_log2 += step;
        if (cells * noise.information() > wanted_bits) noise.odds_log2 -= step;
    }
    return noise.odds_log2;
}

/// Draws a random size, position and orientation of the grid.
void draw_frame(Rng& rng, Reading& reading) {
    core::Grid& grid = reading.grid;
    grid.storage = reading.cells;
    const auto other = static_cast<CodeVariant>(rng.below(3));
    if (rng.below(3) == 0) reading.code = other;
    grid.side = kMaxSide;
    grid.columns = 8 + static_cast<int>(rng.below(6));
    grid.rows = 8 + static_cast<int>(rng.below(6));
    grid.i0 = -static_cast<int>(rng.below(8));
    grid.j0 = -static_cast<int>(rng.below(8));
    reading.turn.quarters = static_cast<int>(rng.below(4));
    reading.place = {{rng.below(kPositionsPerAxis), rng.below(kPositionsPerAxis)},
                     {static_cast<std::uint8_t>(rng.below(kSections)),
                      static_cast<std::uint8_t>(rng.below(kSections))}};
}

void draw(GridKind kind, Rng& rng, Reading& reading) {
    draw_frame(rng, reading);
    core::Grid& grid = reading.grid;
    Noise noise{rng.uniform(2.5, 9), rng.below(2) == 0 ? 0 : rng.uniform(0, 0.25),
                rng.below(2) == 0 ? 127 : 8};
    // In a third of the grids, the paper is blank to the right of a random column.
    const int visible = rng.below(3) == 0 ? 6 + static_cast<int>(rng.below(3)) : grid.columns;
    if (kind == GridKind::doubtful) {
        const int cells = std::min(visible, grid.columns) * grid.rows;
        noise.odds_log2 = draw_odds_of_doubt(cells, noise, rng);
    }
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            GridCell& cell = grid.at(i, j);
            cell = {};
            if (i - grid.i0 >= visible || rng.uniform() < noise.missing) continue;
            const FixedVec step = reading.turn({i, j});
            const Place at = moved(reading.code, reading.place, step.x, step.y);
            const Symbol symbol = symbol_at(reading.code, at.cell, at.section);
            const int x = noise.read(x_bit(symbol), rng);
            const int y = noise.read(y_bit(symbol), rng);
            cell = cell_of(reading.turn, x, y);
        }
    }
}

/// Returns true if the decoded orientation is correct and the symbols at the decoded position are
/// equal to the symbols at the true position.
bool is_right(const Reading& reading, const Decoding& decoding) {
    if (decoding.pattern_from_grid.quarters != reading.turn.quarters) return false;
    const core::Grid& grid = reading.grid;
    const auto symbol = [&](const Place& place, int i, int j) {
        const FixedVec step = reading.turn({i, j});
        const Place at = moved(reading.code, place, step.x, step.y);
        return symbol_at(reading.code, at.cell, at.section);
    };
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            if (symbol(decoding.place, i, j) != symbol(reading.place, i, j)) return false;
        }
    }
    return true;
}

/// Returns the mean information per axis, in bits, computed from the odds per bit that `verify`
/// estimates. p_wrong decreases as the information increases.
double apparent_information(const core::Grid& grid, const Decoding& decoding,
                            const core::Nominal& nominal) {
    core::Confidence confidence;
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            const core::Bits read = core::turned(decoding.pattern_from_grid, grid.at(i, j));
            const Symbol expected = nominal.symbol(nominal.pattern_step({i, j}));
            if (read.x != 0) confidence.add(read.x, (read.x > 0) != (x_bit(expected) == 1));
            if (read.y != 0) confidence.add(read.y, (read.y > 0) != (y_bit(expected) == 1));
        }
    }
    const Noise noise{core::odds_per_bit_q8(confidence) / 256.0, 0, 127};
    double bits = 0;
    for (int level = 0; level < core::Confidence::kLevels; ++level)
        bits += confidence.bits(level) * noise.information(core::Confidence::weight_of(level));
    return bits / 2;
}

/// Returns true if a reading should be verified. This is the case if its p_wrong is probably near
/// 1e-5, where the most readings are needed. The selection also includes enough readings with
/// p_wrong near 1e-4 and 1e-3. Other readings are skipped, because `verify` takes 20 times as long
/// as all previous steps together.
bool looks_doubtful(const core::Grid& grid, const Decoding& decoding,
                    const core::Nominal& nominal) {
    const double bits = apparent_information(grid, decoding, nominal);
    return bits > 62 && bits < 75;
}

}  // namespace

void try_grid(GridKind kind, std::uint64_t seed, std::uint64_t index, IntegrityTally& tally) {
    Rng rng(seed, index);
    Reading reading;
    draw(kind, rng, reading);
    Decoding decoding;
    decoding.window = core::choose_window(reading.grid, kWindowSide);
    decoding.region = core::choose_window(reading.grid, kMaxSide);
    std::array<core::ScoredLine, 2 * kMaxSide> storage;
    if (core::decode_all(reading.grid, reading.code, storage, decoding) != Status::ok) {
        ++tally.unread;
        return;
    }
    const core::Nominal nominal(reading.grid, reading.code, decoding);
    if (kind == GridKind::doubtful && !looks_doubtful(reading.grid, decoding, nominal)) {
        ++tally.skipped;
        return;
    }
    Fix fix;
    core::WorkLimit work(core::WorkLimit::kOfImage);
    const Status status = core::verify(core::kernels(), reading.grid, reading.code, nullptr,
                                       kAcceptAll, storage, work, decoding, fix);
    if (status != Status::ok) {
        ++tally.unread;
        return;
    }
    tally.add(fix.p_wrong_log2, !is_right(reading, decoding));
}
}  // namespace dotpose::tables

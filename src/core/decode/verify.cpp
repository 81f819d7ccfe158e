#include "core/decode/verify.hpp"

#include "core/decode/confidence.hpp"
#include "core/decode/lines.hpp"
#include "core/decode/rivals.hpp"
#include "core/decode/upright.hpp"

namespace dotpose::core {
namespace {

/// Bits of one axis that were read and compared with the code.
struct Agreement {
    int bits = 0;
    int errors = 0;
    Confidence confidence;
};

Agreement compare(const Grid& grid, Turn pattern_from_grid, const Nominal& nominal, Axis axis) {
    Agreement agreement;
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            const GridCell& cell = grid.at(i, j);
            const Bits read = turned(pattern_from_grid, cell);
            const int weight = axis == Axis::x ? read.x : read.y;
            if (weight == 0) continue;
            const Symbol expected = nominal.symbol(nominal.pattern_step({i, j}));
            const int bit = axis == Axis::x ? x_bit(expected) : y_bit(expected);
            const bool is_wrong = (weight > 0) != (bit == 1);
            agreement.confidence.add(weight, is_wrong);
            agreement.errors += is_wrong;
            ++agreement.bits;
        }
    }
    return agreement;
}

AxisReading reading_of(Profile profile, std::uint32_t position, int section, std::uint32_t cross) {
    const int here = roll(profile, position) + section + static_cast<int>(cross % kSections);
    return {position, static_cast<std::uint8_t>(here % kSections), 0, 0};
}

}  // namespace

Status verify(const Grid& grid, Profile profile, const Decoding& decoding, const Nominal& nominal,
              const IntegrityOptions& options, std::span<LineScores> storage, Fix& fix) {
    const Upright upright(grid, decoding.region, decoding.pattern_from_grid);
    const Vec corner = decoding.pattern_from_grid(upright.corner());
    const Place place = moved(profile, decoding.place, corner.x, corner.y);
    const std::array<Agreement, 2> agreements{
        compare(grid, decoding.pattern_from_grid, nominal, Axis::x),
        compare(grid, decoding.pattern_from_grid, nominal, Axis::y)};
    fix.bit_errors = agreements[0].errors + agreements[1].errors;
    fix.p_wrong_log2 = 0;
    for (const Agreement& agreement : agreements) {
        // Two patterns in view.
        if (agreement.errors > agreement.bits * options.max_bit_error_q8 / 256) {
            return Status::not_certain;
        }
    }
    // Both axes are read from the same dots, and so are misread alike.
    Confidence both = agreements[0].confidence;
    both.add(agreements[1].confidence);
    const int odds = odds_per_bit_q8(both);
    int p_wrong_q8 = kNever_q8;
    for (const Agreement& agreement : agreements) {
        p_wrong_q8 = add_log2(p_wrong_q8, 256 * chance_log2(agreement.confidence, odds));
    }
    // Rivals take long to count, and only add to this.
    if (p_wrong_q8 > 256 * options.max_p_wrong_log2) return Status::not_certain;
    for (const Axis axis : {Axis::x, Axis::y}) {
        const AxisReading reading =
            axis == Axis::x ? reading_of(profile, place.cell.x, place.section.u, place.cell.y)
                            : reading_of(profile, place.cell.y, place.section.v, place.cell.x);
        const Lines lines = score_lines(upright, axis, storage);
        p_wrong_q8 = add_log2(p_wrong_q8, 256 * rivals_log2(profile, lines, reading, odds));
    }
    fix.p_wrong_log2 = std::min((p_wrong_q8 + 255) >> 8, 0);
    return fix.p_wrong_log2 <= options.max_p_wrong_log2 ? Status::ok : Status::not_certain;
}

}  // namespace dotpose::core

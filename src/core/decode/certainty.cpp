#include "core/decode/certainty.hpp"

#include <algorithm>

#include "code/rolls.hpp"
#include "core/decode/quick_rivals.hpp"
#include "core/decode/seam_rivals.hpp"
#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

/// log2 of the probability that one axis is wrong, in 2^-8; above the limit, no more than that.
int axis_wrong_log2_q8(const Confidence& bits, const Lines& lines, Profile profile,
                       const AxisReading& reading, int odds_per_bit, int limit_q8) {
    int sum_q8 = 256 * chance_log2(bits, odds_per_bit);
    if (sum_q8 > limit_q8) return 0;
    const Contest contest(profile, lines, reading, odds_per_bit);
    sum_q8 = add_log2(sum_q8, quick_rivals_log2_q8(contest, limit_q8));
    if (sum_q8 > limit_q8) return 0;
    return std::min(add_log2(sum_q8, seam_rivals_log2_q8(contest)), 0);
}

}  // namespace

bool is_certain(const Evidence& evidence, Profile profile, const IntegrityOptions& options,
                Fix& fix) {
    const auto& [x_bits, y_bits] = evidence.bits;
    fix.bit_errors = x_bits.wrong() + y_bits.wrong();
    for (const Confidence& bits : evidence.bits) {
        // Two patterns in view.
        if (256 * bits.wrong() > bits.bits() * options.max_bit_error_q8) return false;
    }
    // Both axes are read from the same dots, and so are misread alike.
    Confidence both = x_bits;
    both.add(y_bits);
    const int odds = odds_per_bit_q8(both);
    if (odds == 0) return false;
    const int limit_q8 = 256 * options.max_p_wrong_log2;
    const auto& [cell, section] = evidence.corner;
    const auto roll = [&](std::uint32_t position, int own_section, std::uint32_t cross) {
        return static_cast<std::uint8_t>(code::roll_from(profile, position, own_section, cross));
    };
    const AxisReading x{cell.x, roll(cell.x, section.u, cell.y), 0, 0};
    const AxisReading y{cell.y, roll(cell.y, section.v, cell.x), 0, 0};
    const int x_q8 = axis_wrong_log2_q8(x_bits, evidence.columns, profile, x, odds, limit_q8);
    if (x_q8 > limit_q8) return false;
    const int y_q8 = axis_wrong_log2_q8(y_bits, evidence.rows, profile, y, odds, limit_q8);
    fix.p_wrong_log2 = std::min((add_log2(x_q8, y_q8) + 255) >> 8, 0);
    return fix.p_wrong_log2 <= options.max_p_wrong_log2;
}

}  // namespace dotpose::core

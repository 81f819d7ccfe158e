#include "core/integrity/certainty.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "code/rolls.hpp"
#include "core/integrity/alternative_sets.hpp"
#include "core/integrity/alternatives.hpp"
#include "core/integrity/seam_alternatives.hpp"
#include "core/integrity/tabled_alternatives.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/integrity/weigh_codes.hpp"
#include "core/math/fixed.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// Number of shifts, out of 63, at which an alternative does not share a given line.
constexpr float kShifts = kSections - 1;
/// Upper bound on the odds of a single alternative that is not evaluated, as log2 in units of 2^-8
/// and as a plain value.
constexpr int kSkippedOdds_q8 = -52 * 256;
constexpr float kSkippedOdds = 2.3e-16F;
/// Total number of places in the four sequences.
constexpr float kSingles = 741;

/// Variant of `LikelihoodRatios::odds` that does not clamp large odds. Avoids 64-bit integers,
/// because converting them to floating point may require a library call.
float odds_of(const LikelihoodRatios& ratios, int lost) {
    const int log2_q8 = std::max(ratios.log2_odds_q8(lost), kNegligible_q8);
    const int whole = log2_q8 >> 8;
    return static_cast<float>(static_cast<std::int32_t>(exp2_q16(log2_q8 - whole * 256))) *
           power_of_two_exactly(whole - 16);
}

constexpr FarAlternatives kFarAlternatives = [] {
    FarAlternatives sets;
    for (std::size_t i = 0; i < kAlternativeSets.size(); ++i) {
        sets.equal[i] = power_of_two_rounded_up(kAlternativeSets[i].equal_q8 + kUnevenness_q8);
        sets.number[i] = power_of_two_rounded_up(kAlternativeSets[i].alternatives_q8);
    }
    return sets;
}();

/// Returns an upper bound on the expected odds of the far alternatives. Computes the same bound as
/// `far_log2_q8` in quick_alternatives.cpp with `roughly` = true, but in floating point and for all
/// alternative sets in parallel.
float far_alternatives(const Kernels& kernels, const LikelihoodRatios& ratios) {
    std::array<float, kMaxLines> odds;
    const auto count = static_cast<std::size_t>(ratios.count());
    int last_loss = ratios.min_loss(0);
    float last_odds = odds_of(ratios, last_loss);
    for (std::size_t line = 0; line < count; ++line) {
        const int loss = ratios.min_loss(static_cast<int>(line));
        if (loss != last_loss) last_odds = odds_of(ratios, loss);
        last_loss = loss;
        odds[line] = last_odds;
    }
    return kernels.sum_far_alternatives(std::span(odds).first(count), ratios.max_shared(),
                                        kFarAlternatives);
}

/// Returns an upper bound on the summed odds of the alternatives that share no line: the reading's
/// position in other sections, and single alternatives at shifts without a shared line.
float sharing_none(const LikelihoodRatios& ratios) {
    return (1 + kSingles) * kShifts * odds_of(ratios, ratios.min_loss_of_all());
}

/// Loss caused by one wrong bit, in score units. All bits have the full weight, so losses are
/// multiples of kBit.
constexpr int kBit = 2 * 127;
/// Writes the lines and their minimum losses to `losses`, sorted by decreasing loss. Losses are in
/// bits and are clamped to [0, kMaxBits]. Returns the number of lines.
std::size_t sort_losses(const LikelihoodRatios& ratios, std::span<LineLoss> losses) {
    constexpr int kMaxBits = 31;
    const auto count = static_cast<std::size_t>(ratios.count());
    std::array<std::uint8_t, kMaxLines> bits;
    // Counting sort. begin[b] is first the number of lines that lose b bits, and later the index of
    // the first of these lines.
    std::array<std::uint8_t, kMaxBits + 1> begin{};
    for (std::size_t line = 0; line < count; ++line) {
        const int loss = ratios.min_loss(static_cast<int>(line)) / kBit;
        bits[line] = static_cast<std::uint8_t>(std::clamp(loss, 0, kMaxBits));
        ++begin[bits[line]];
    }
    std::uint8_t before = 0;
    for (std::size_t n = begin.size(); n-- > 0;) {
        const std::uint8_t here = begin[n];
        begin[n] = before;
        before = static_cast<std::uint8_t>(before + here);
    }
    for (std::size_t line = 0; line < count; ++line)
        losses[begin[bits[line]]++] = {static_cast<std::uint8_t>(line), bits[line]};
    return count;
}

/// Returns the loss of a single alternative at the shift at which it shares the line `shared`. If
/// the odds cannot exceed kSkippedOdds, stops early and returns the loss so far.
int loss_of(const LikelihoodRatios& ratios, std::size_t sequence, std::uint32_t place, int shared) {
    const std::uint8_t* own = ratios.basis[sequence].rolls + ratios.places[sequence];
    const std::uint8_t* alternative = ratios.basis[sequence].rolls + place;
    const int base = alternative[shared] - own[shared];
    int lost = 0;
    const int loss_limit = ratios.loss_for(kSkippedOdds_q8) + ratios.max_gain();
    for (int line = 0; line < ratios.count() && lost <= loss_limit; ++line) {
        int shift = alternative[line] - own[line] - base;
        shift += shift < 0 ? kSections : 0;
        shift -= shift >= kSections ? kSections : 0;
        lost += ratios.loss(line, shift < 0 ? shift + kSections : shift);
    }
    return lost;
}

/// Returns an upper bound on the odds of the single alternatives that share a line. Adds the bound
/// from `tabled_alternatives` for each sequence in which this bound is at most `limit` / 12. In the
/// other sequences, lists the places whose odds may exceed kSkippedOdds, and adds their odds. Also
/// adds kSkippedOdds for each place and line, to cover the places that are not listed. Returns 1 if
/// `Kernels::list_similar_places` returns false.
float single_alternatives(const Kernels& kernels, const LikelihoodRatios& ratios,
                          const UnsharedLines& unshared, float limit) {
    unsigned sequences = 15;
    float sum = tabled_alternatives(kernels, unshared, limit / 12, sequences);
    if (sequences == 0) return sum;
    std::array<LineLoss, kMaxLines> storage;
    const std::size_t lines = sort_losses(ratios, storage);
    const int loss_limit = (ratios.loss_for(kSkippedOdds_q8) + ratios.max_gain()) / kBit + 1;
    sum += kSingles * kSkippedOdds * static_cast<float>(lines);
    SimilarPlaceList list;
    if (!kernels.list_similar_places(ratios.basis, ratios.places, sequences,
                                     std::span(storage).first(lines), loss_limit, list)) {
        return 1;
    }
    for (const auto& [sequence, place, line] :
         std::span(list.places).first(static_cast<std::size_t>(list.count)))
        sum += odds_of(ratios, loss_of(ratios, sequence, place, line));
    return sum;
}

/// Returns an upper bound on the summed odds of all alternatives except seam alternatives. If the
/// bound exceeds `limit` even without the single alternatives that share a line, omits these single
/// alternatives, because the caller rejects the position anyway.
float alternatives(const Kernels& kernels, const LikelihoodRatios& ratios,
                   const UnsharedLines& unshared, float limit) {
    const float sum = far_alternatives(kernels, ratios) + sharing_none(ratios);
    return sum > limit ? sum : sum + single_alternatives(kernels, ratios, unshared, limit);
}

/// Returns the summed odds of the seam alternatives, rounded up.
float seam_alternatives(const Kernels& kernels, const UnsharedLines& unshared) {
    return power_of_two_rounded_up(seam_alternatives_log2_q8(kernels, unshared));
}

/// Parameters of the certainty test. Both axes use the same values.
struct Query {
    CodeVariant code;
    int odds_per_bit_q8;
    int limit_log2;
    OtherCodes* others;  ///< odds of the other codes; null if not requested
};

bool is_code_in_question(const Query& query) {
    return query.others != nullptr && query.others->log2_in_question_q8 >= 0;
}

/// Returns an upper bound on the probability that random bits agree with any place in the code at
/// least as well as the bits of one axis agree with the reading.
float chance_of(const Confidence& bits, const Query& query) {
    if (!is_code_in_question(query))
        return power_of_two_exactly(chance_log2(bits, query.odds_per_bit_q8));
    return power_of_two_rounded_up(
        chance_log2_q8(bits, query.odds_per_bit_q8, query.others->log2_in_question_q8));
}

/// Returns the weighted number of possible codes, or 1 if the code is given. The weight of a code
/// is its odds relative to the code that was read. The odds of the alternatives are multiplied by
/// this number, because all codes have the same number of alternatives.
float codes_in_question(const Query& query) {
    return !is_code_in_question(query) ? 1
                                       : power_of_two_rounded_up(query.others->log2_in_question_q8);
}

/// Returns an upper bound on the probability that the position is wrong along at least one axis.
/// The result may be 1 if the bound exceeds 2^limit_log2. If a fast bound on the alternatives is
/// too large, computes a tighter bound. The tighter bound is not available for hard bits.
float wrong_on_any_axis(const Kernels& kernels, const std::array<Confidence, 2>& bits,
                        const std::array<const UnsharedLines*, 2>& axes, const Query& query,
                        WorkLimit& work) {
    const float limit = power_of_two_exactly(query.limit_log2);
    const float codes = codes_in_question(query);
    float wrong = 0;
    std::array<const UnsharedLines*, 2> in_doubt;
    std::size_t count = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const UnsharedLines& unshared = *axes[i];
        const LikelihoodRatios& ratios = unshared.ratios();
        const float chance = chance_of(bits[i], query);
        wrong += chance;
        if (wrong > limit) return 1;
        // Each axis may use half of the limit. A tighter bound is computed only if the fast bound
        // exceeds this half.
        const float enough = limit / 2 - chance;
        const float sum = codes * alternatives(kernels, ratios, unshared, limit);
        if (sum > enough && !ratios.is_of_bits()) {
            in_doubt[count++] = &unshared;
            continue;
        }
        if (sum > limit) return 1;
        wrong += sum + seam_alternatives(kernels, unshared);
    }
    if (count == 0) return wrong;
    // The factor covers the rounding errors of the sums.
    return wrong + wrong_by_alternatives(kernels, std::span(in_doubt).first(count), codes,
                                         0.999F * limit - wrong, work);
}

/// Returns true if the bounds on the error probabilities of both axes add up to at most
/// 2^limit_log2. On success, sets `fix.p_wrong_log2` and, unless `Query::others` is null, the odds
/// of the other codes. On failure, `fix.p_wrong_log2` may be set or left unchanged.
bool are_certain(const Kernels& kernels, const std::array<Confidence, 2>& bits,
                 const LikelihoodRatios& x, const LikelihoodRatios& y, const Query& query,
                 WorkLimit& work, Fix& fix) {
    const UnsharedLines x_unshared(kernels, x);
    const UnsharedLines y_unshared(kernels, y);
    const float wrong = wrong_on_any_axis(kernels, bits, {&x_unshared, &y_unshared}, query, work);
    if (wrong >= 1) return false;
    if (!is_within_limit(wrong, query.limit_log2, fix)) return false;
    if (query.others == nullptr) return true;
    weigh_other_codes(kernels, x_unshared, y_unshared, query.code, *query.others);
    return true;
}

/// Returns the odds that a bit with the full weight is correct, as log2 in units of 2^-8. Combines
/// the bits of both axes, because they come from the same dots. Returns 0 if the bits contain no
/// information, or if an axis has too many wrong bits. Sets `fix.bit_errors`.
int odds_of_bits_q8(const Confidence& x, const Confidence& y, const IntegrityOptions& options,
                    Fix& fix) {
    fix.bit_errors = x.wrong() + y.wrong();
    for (const Confidence* bits : {&x, &y}) {
        // Rejects a position with too many wrong bits, because the view probably contains two
        // patterns.
        if (256 * bits->wrong() > bits->bits() * options.max_bit_error_q8) return 0;
    }
    Confidence both = x;
    both.add(y);
    return odds_per_bit_q8(both, options.bits_per_error);
}

/// Returns the readings of the column and the row that cross at `corner`.
std::array<AxisReading, 2> readings_at(const Place& corner, CodeVariant code) {
    const auto& [cell, section] = corner;
    const auto roll = [&](std::uint32_t position, int own_section, std::uint32_t cross) {
        return static_cast<std::uint8_t>(code::roll_from(code, position, own_section, cross));
    };
    return {AxisReading{cell.x, roll(cell.x, section.u, cell.y), 0, 0},
            AxisReading{cell.y, roll(cell.y, section.v, cell.x), 0, 0}};
}

}  // namespace

bool is_within_limit(float wrong, int limit_log2, Fix& fix) {
    int exponent = 0;
    std::frexp(wrong, &exponent);  // wrong < 2^exponent
    fix.p_wrong_log2 = std::min(exponent, 0);
    return fix.p_wrong_log2 <= limit_log2;
}

bool passes_hard_bit_test(const Kernels& kernels, const std::array<AxisBits, 2>& axes,
                          CodeVariant code, const IntegrityOptions& options, Fix& fix,
                          OtherCodes* others) {
    const auto& [x, y] = axes;
    const int odds_q8 = odds_of_bits_q8(x.confidence, y.confidence, options, fix);
    if (odds_q8 == 0) return false;
    if (std::min(x.lines.size(), y.lines.size()) <= kMaxShared) return false;
    const auto ratios_of = [&](const AxisBits& axis) {
        return LikelihoodRatios(code, axis.lines, axis.reading, odds_q8, axis.rolls);
    };
    WorkLimit none(0);  // this test does not count alternatives one by one
    return are_certain(kernels, {x.confidence, y.confidence}, ratios_of(x), ratios_of(y),
                       {code, odds_q8, options.max_p_wrong_log2, others}, none, fix);
}

std::array<Confidence, 2> compared_with_code(CodeVariant code, const Place& place,
                                             const BitBlock& block) {
    const Place corner = moved(code, place, -BitBlock::kMiddle, -BitBlock::kMiddle);
    const auto compared = [&](const BitLines& lines, const AxisReading& first) {
        std::array<std::uint8_t, BitBlock::kSide> rolls;
        code::follow_rolls(code, first.position, first.roll, rolls);
        int read = 0;
        int wrong = 0;
        for (std::size_t line = 0; line < rolls.size(); ++line) {
            read += std::popcount(lines.valid[line]);
            wrong += std::popcount(lines.valid[line] &
                                   (lines.bits[line] ^ code::main_bits(rolls[line])));
        }
        return Confidence::of_hard_bits(read, wrong);
    };
    const auto [column, row] = readings_at(corner, code);
    return {compared(block.columns, column), compared(block.rows, row)};
}

Evidence evidence_of(const Kernels& kernels, CodeVariant code, const Place& place,
                     const BitBlock& block, const std::array<Confidence, 2>& bits,
                     std::span<ScoredLine> storage) {
    const BlockLines lines = score_block(kernels, block, storage);
    const Place corner = moved(code, place, lines.first_column - BitBlock::kMiddle,
                               lines.first_row - BitBlock::kMiddle);
    return {corner, bits, lines.columns, lines.rows};
}

bool is_certain(const Kernels& kernels, const Evidence& evidence, CodeVariant code,
                const IntegrityOptions& options, WorkLimit& work, Fix& fix, OtherCodes* others) {
    const auto& [x_bits, y_bits] = evidence.bits;
    const int odds_q8 = odds_of_bits_q8(x_bits, y_bits, options, fix);
    if (odds_q8 == 0) return false;
    if (std::min(evidence.columns.count(), evidence.rows.count()) <= kMaxShared) return false;
    const auto [x, y] = readings_at(evidence.corner, code);
    return are_certain(kernels, evidence.bits, LikelihoodRatios(code, evidence.columns, x, odds_q8),
                       LikelihoodRatios(code, evidence.rows, y, odds_q8),
                       {code, odds_q8, options.max_p_wrong_log2, others}, work, fix);
}

void weigh_other_codes(const Kernels& kernels, const Evidence& evidence, CodeVariant code,
                       OtherCodes& others) {
    Confidence both = evidence.bits[0];
    both.add(evidence.bits[1]);
    const int odds_q8 = odds_per_bit_q8(both);
    if (odds_q8 == 0) return;
    const auto [x, y] = readings_at(evidence.corner, code);
    const LikelihoodRatios by_x(code, evidence.columns, x, odds_q8);
    const LikelihoodRatios by_y(code, evidence.rows, y, odds_q8);
    weigh_other_codes(kernels, UnsharedLines(kernels, by_x), UnsharedLines(kernels, by_y), code,
                      others);
}

}  // namespace dotpose::core

#include "core/integrity/verify.hpp"

#include "code/rolls.hpp"
#include "code/tables.hpp"
#include "core/decode/lines.hpp"
#include "core/decode/upright.hpp"
#include "core/integrity/alternatives.hpp"
#include "core/integrity/confidence.hpp"
#include "core/integrity/quick_alternatives.hpp"
#include "core/integrity/seam_alternatives.hpp"
#include "core/integrity/unshared_lines.hpp"
#include "core/integrity/weigh_codes.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

AxisReading reading_of(CodeVariant code, const Place& place, Axis axis) {
    const bool is_x = axis == Axis::x;
    const std::uint32_t position = is_x ? place.cell.x : place.cell.y;
    const std::uint32_t cross = is_x ? place.cell.y : place.cell.x;
    const int section = is_x ? place.section.u : place.section.v;
    const int here = code::roll_from(code, position, section, cross);
    return {position, static_cast<std::uint8_t>(here), 0, 0};
}

// Not inlined, because small processors have too few registers for the combined loops.
[[gnu::noinline]] void compare_line(std::span<const std::int8_t> line, const std::uint8_t* bit,
                                    Confidence& confidence) {
    for (const std::int8_t weight : line) {
        const int agreement = *bit++ != 0 ? weight : -weight;
        if (agreement != 0) confidence.add(agreement, agreement < 0);
    }
}

Confidence compare(CodeVariant code, const Upright& upright, Axis axis,
                   const AxisReading& reading) {
    Confidence confidence;
    Line storage;
    const int lines = axis == Axis::x ? upright.columns() : upright.rows();
    std::array<std::uint8_t, kMaxGridSide> rolls;
    code::follow_rolls(code, reading.position, reading.roll,
                       std::span(rolls).first(static_cast<std::size_t>(lines)));
    for (int i = 0; i < lines; ++i) {
        const auto line = axis == Axis::x ? upright.column(i, storage) : upright.row(i, storage);
        compare_line(line, code::kMainRepeated.data() + rolls[static_cast<std::size_t>(i)],
                     confidence);
    }
    return confidence;
}

/// Returns the place of the upper left symbol in an upright grid.
Place corner_place(CodeVariant code, const Decoding& decoding, const Upright& upright) {
    const FixedVec corner = decoding.pattern_from_grid(upright.corner());
    return moved(code, decoding.place, corner.x, corner.y);
}

/// Result of comparing all bits in view with the code, before alternatives are evaluated.
struct Doubt {
    /// Odds that a bit with weight 127 is correct, as log2 in units of 2^-8. The value is 0 if the
    /// bits contain no information, or if too many bits are wrong.
    int odds_per_bit_q8 = 0;
    /// Upper bound on the probability of a chance match on each axis, as log2 in units of 2^-8. In
    /// a chance match, random bits agree with any place in the code at least as well as the bits
    /// that were read agree with the position.
    std::array<int, 2> by_chance_q8{};
};

/// Computes the odds per bit and the bounds on the probability of a chance match from the agreement
/// of the x and y bits with the code. Sets `decoding.bits` and `fix.bit_errors`.
Doubt doubt_of(const std::array<Confidence, 2>& agreements, const IntegrityOptions& options,
               Decoding& decoding, Fix& fix) {
    decoding.bits = agreements[0].bits() + agreements[1].bits();
    fix.bit_errors = agreements[0].wrong() + agreements[1].wrong();
    for (const Confidence& agreement : agreements) {
        // Rejects a position with too many wrong bits, because the view probably contains two
        // patterns.
        if (agreement.wrong() > agreement.bits() * options.max_bit_error_q8 / 256) return {};
    }
    // Combines both axes, because their bits come from the same dots and have the same error rate.
    Confidence both = agreements[0];
    both.add(agreements[1]);
    Doubt doubt{odds_per_bit_q8(both, options.bits_per_error), {}};
    for (std::size_t i = 0; i < agreements.size(); ++i) {
        doubt.by_chance_q8[i] = 256 * chance_log2(agreements[i], doubt.odds_per_bit_q8);
    }
    return doubt;
}

/// Returns the agreement of all x bits and of all y bits with the code at the decoded position.
std::array<Confidence, 2> compare_both(const Grid& grid, CodeVariant code,
                                       const Decoding& decoding) {
    const Upright all(grid, {grid.i0, grid.j0, grid.columns, grid.rows},
                      decoding.pattern_from_grid);
    const Place corner = corner_place(code, decoding, all);
    return {compare(code, all, Axis::x, reading_of(code, corner, Axis::x)),
            compare(code, all, Axis::y, reading_of(code, corner, Axis::y))};
}

Doubt compare_with_chance(const Grid& grid, CodeVariant code, const IntegrityOptions& options,
                          Decoding& decoding, Fix& fix) {
    return doubt_of(compare_both(grid, code, decoding), options, decoding, fix);
}

/// Returns an upper bound on the probability that the position is wrong along one axis: the sum of
/// the bound on the probability of a chance match and the odds of the alternatives. Adds the odds
/// of seam alternatives only if this sum is at most `limit_q8`. All values are log2 in units of
/// 2^-8.
int with_seams(const LikelihoodRatios& ratios, int by_chance_q8, int limit_q8,
               int alternatives_q8) {
    int sum_q8 = add_log2(by_chance_q8, alternatives_q8);
    if (sum_q8 <= limit_q8) sum_q8 = add_log2(sum_q8, seam_alternatives_log2_q8(ratios));
    return std::min(sum_q8, 0);
}

/// Scores the lines of one axis in the decoded region, or reuses the scores of the decoder, and
/// returns their likelihood ratios.
LikelihoodRatios ratios_of(Axis axis, const Grid& grid, CodeVariant code, const Decoding& decoding,
                           std::span<ScoredLine> storage, int odds_per_bit_q8) {
    const Upright upright(grid, decoding.region, decoding.pattern_from_grid);
    const auto half = scores_of(axis, storage);
    const Lines lines = decoding.lines_are_scored ? scored_lines(upright, axis, half)
                                                  : score_lines(upright, axis, half);
    const Place place = corner_place(code, decoding, upright);
    return {code, lines, reading_of(code, place, axis), odds_per_bit_q8};
}

/// Returns an upper bound on the probability that the position is wrong, as log2 in units of 2^-8.
/// Uses the bound on the alternatives from quick_alternatives.hpp. `log2_codes_q8` is log2 of the
/// weighted number of possible codes, in units of 2^-8. Returns 0 (probability 1) if the bound on
/// the probability of a chance match exceeds `limit_q8` on an axis.
int estimate_quickly(const Grid& grid, CodeVariant code, const Decoding& decoding,
                     std::span<ScoredLine> storage, const Doubt& doubt, int limit_q8,
                     int log2_codes_q8) {
    int p_wrong_q8 = kNever_q8;
    for (const Axis axis : {Axis::x, Axis::y}) {
        const int by_chance_q8 = doubt.by_chance_q8[static_cast<std::size_t>(axis)];
        if (by_chance_q8 > limit_q8) return 0;
        const LikelihoodRatios ratios =
            ratios_of(axis, grid, code, decoding, storage, doubt.odds_per_bit_q8);
        const int alternatives_q8 = quick_alternatives_log2_q8(ratios, limit_q8) + log2_codes_q8;
        p_wrong_q8 =
            add_log2(p_wrong_q8, with_seams(ratios, by_chance_q8, limit_q8, alternatives_q8));
    }
    return p_wrong_q8;
}

/// Returns true if the position must be rejected regardless of the alternatives:
/// - if the bits contain no information,
/// - if too many bits are wrong, or
/// - if the bounds on the probability of a chance match, summed over both axes, exceed `limit_q8`.
bool is_hopeless(const Doubt& doubt, int limit_q8) {
    return doubt.odds_per_bit_q8 == 0 ||
           add_log2(doubt.by_chance_q8[0], doubt.by_chance_q8[1]) > limit_q8;
}

Status judge(const Doubt& doubt, int p_wrong_q8, const IntegrityOptions& options, Fix& fix) {
    fix.p_wrong_log2 = std::min((p_wrong_q8 + 255) >> 8, 0);
    const bool is_sure = !is_hopeless(doubt, 256 * options.max_p_wrong_log2) &&
                         fix.p_wrong_log2 <= options.max_p_wrong_log2;
    return is_sure ? Status::ok : Status::not_certain;
}

}  // namespace

Status verify_quickly(const Grid& grid, CodeVariant code, Decoding& decoding,
                      const IntegrityOptions& options, std::span<ScoredLine> storage, Fix& fix) {
    const int limit_q8 = 256 * options.max_p_wrong_log2;
    const Doubt doubt = compare_with_chance(grid, code, options, decoding, fix);
    const int p_wrong_q8 =
        is_hopeless(doubt, limit_q8)
            ? 0
            : estimate_quickly(grid, code, decoding, storage, doubt, limit_q8, 0);
    return judge(doubt, p_wrong_q8, options, fix);
}

namespace {

/// Lines of one axis in a tracked frame, from the first line with bits to the last.
struct TrackedAxis {
    std::span<const ComparedLine> lines;
    AxisReading reading;
    Confidence confidence;
};

TrackedAxis tracked_axis(CodeVariant code, std::span<const ComparedLine> columns_and_rows,
                         const Place& corner, Axis axis) {
    const auto all = axis == Axis::x ? columns_and_rows.first(kMaxComparedLines)
                                     : columns_and_rows.last(kMaxComparedLines);
    std::size_t begin = 0;
    std::size_t end = all.size();
    while (begin < end && all[begin].seen == 0)
        ++begin;
    while (begin < end && all[end - 1].seen == 0)
        --end;
    TrackedAxis result;
    result.lines = all.subspan(begin, end - begin);
    int seen = 0;
    int wrong = 0;
    for (const ComparedLine& line : result.lines) {
        seen += bits_in(line.seen);
        // Skips the count for lines without wrong bits, because counting is slow on processors
        // without a popcount instruction.
        if (line.wrong != 0) wrong += bits_in(line.wrong);
    }
    result.confidence = Confidence::of_hard_bits(seen, wrong);
    // The reading contains the position of the first line with bits, and the roll of this line at
    // its first cell.
    const auto ahead = static_cast<std::int32_t>(begin);
    result.reading = axis == Axis::x ? reading_of(code, moved(code, corner, ahead, 0), axis)
                                     : reading_of(code, moved(code, corner, 0, ahead), axis);
    return result;
}

}  // namespace

Status verify_tracked(CodeVariant code, std::span<const ComparedLine> lines, const Place& corner,
                      const IntegrityOptions& options, Decoding& decoding, Fix& fix) {
    const std::array axes{tracked_axis(code, lines, corner, Axis::x),
                          tracked_axis(code, lines, corner, Axis::y)};
    const Doubt doubt = doubt_of({axes[0].confidence, axes[1].confidence}, options, decoding, fix);
    const int limit_q8 = 256 * options.max_p_wrong_log2;
    if (is_hopeless(doubt, limit_q8)) return judge(doubt, 0, options, fix);
    int p_wrong_q8 = kNever_q8;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const LikelihoodRatios ratios(code, axes[i].lines, axes[i].reading, doubt.odds_per_bit_q8);
        p_wrong_q8 = add_log2(p_wrong_q8, with_seams(ratios, doubt.by_chance_q8[i], limit_q8,
                                                     quick_alternatives_log2_q8(ratios, limit_q8)));
    }
    return judge(doubt, p_wrong_q8, options, fix);
}

namespace {

/// Replaces the bounds on the probability of a chance match, which assume a single code, with
/// bounds for several candidate codes. `log2_codes_q8` is log2 of the number of candidate codes,
/// weighted by their odds, in units of 2^-8.
void count_hypotheses_of(int log2_codes_q8, const Grid& grid, CodeVariant code,
                         const Decoding& decoding, Doubt& doubt) {
    const auto agreements = compare_both(grid, code, decoding);
    for (std::size_t i = 0; i < agreements.size(); ++i) {
        doubt.by_chance_q8[i] = chance_log2_q8(agreements[i], doubt.odds_per_bit_q8, log2_codes_q8);
    }
}

/// Returns an upper bound on the probability that the position is wrong, as log2 in units of 2^-8,
/// or 0 (probability 1) if it exceeds 2^limit_log2 or cannot be computed within the work limit.
/// Counts alternatives one by one.
int count_alternatives(const Kernels& kernels, const LikelihoodRatios& x, const LikelihoodRatios& y,
                       const Doubt& doubt, int limit_log2, int log2_codes_q8, WorkLimit& work) {
    if (std::min(x.count(), y.count()) <= kMaxShared) return 0;
    const UnsharedLines x_unshared(kernels, x);
    const UnsharedLines y_unshared(kernels, y);
    const std::array axes{&x_unshared, &y_unshared};
    const float chance =
        power_of_two_rounded_up(add_log2(doubt.by_chance_q8[0], doubt.by_chance_q8[1]));
    const float wrong = wrong_by_alternatives(kernels, axes, power_of_two_rounded_up(log2_codes_q8),
                                              power_of_two_exactly(limit_log2) - chance, work);
    return wrong >= 1 ? 0 : log2_of_odds_q8(chance + wrong);
}

}  // namespace

void weigh_other_codes(const Kernels& kernels, const Grid& grid, CodeVariant code,
                       const Decoding& decoding, std::span<ScoredLine> storage,
                       OtherCodes* others) {
    if (others == nullptr) return;
    auto [both, of_y] = compare_both(grid, code, decoding);
    both.add(of_y);
    const int odds_q8 = odds_per_bit_q8(both);
    if (odds_q8 == 0) return;
    const LikelihoodRatios x = ratios_of(Axis::x, grid, code, decoding, storage, odds_q8);
    const LikelihoodRatios y = ratios_of(Axis::y, grid, code, decoding, storage, odds_q8);
    weigh_other_codes(kernels, UnsharedLines(kernels, x), UnsharedLines(kernels, y), code, *others);
}

Status verify(const Kernels& kernels, const Grid& grid, CodeVariant code, const OtherCodes* others,
              const IntegrityOptions& options, std::span<ScoredLine> storage, WorkLimit& work,
              Decoding& decoding, Fix& fix) {
    const int limit_q8 = 256 * options.max_p_wrong_log2;
    Doubt doubt = compare_with_chance(grid, code, options, decoding, fix);
    if (doubt.odds_per_bit_q8 == 0) return judge(doubt, 0, options, fix);
    const bool is_code_given = others == nullptr || others->log2_in_question_q8 < 0;
    const int codes_q8 = is_code_given ? 0 : others->log2_in_question_q8;
    if (!is_code_given) count_hypotheses_of(codes_q8, grid, code, decoding, doubt);
    if (is_hopeless(doubt, limit_q8)) return judge(doubt, 0, options, fix);
    int p_wrong_q8 = estimate_quickly(grid, code, decoding, storage, doubt, limit_q8, codes_q8);
    // A tighter bound is computed if the quick bound exceeds the caller's limit or the default
    // limit.
    if (p_wrong_q8 > std::min(limit_q8, -30 * 256)) {
        const auto ratios = [&](Axis axis) {
            return ratios_of(axis, grid, code, decoding, storage, doubt.odds_per_bit_q8);
        };
        p_wrong_q8 = std::min(p_wrong_q8,
                              count_alternatives(kernels, ratios(Axis::x), ratios(Axis::y), doubt,
                                                 options.max_p_wrong_log2, codes_q8, work));
    }
    return judge(doubt, p_wrong_q8, options, fix);
}

}  // namespace dotpose::core

#include "core/decode/certainty.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "code/rolls.hpp"
#include "core/decode/least_losses.hpp"
#include "core/decode/quick_rivals.hpp"
#include "core/decode/rival_sets.hpp"
#include "core/decode/rivals.hpp"
#include "core/decode/seam_rivals.hpp"
#include "core/fixed.hpp"
#include "core/vectors.hpp"

namespace dotpose::core {
namespace {

/// Shifts at which a rival shares no line.
constexpr float kShifts = kSections - 1;
/// Odds at which single rivals are counted that have less; and how many there are, with all their
/// shifts.
constexpr int kPassedOver_q8 = -52 * 256;
constexpr float kPassedOver = 2.3e-16F;
constexpr float kSingles = 741;

/// 2^n as it is, -126 <= n < 128.
constexpr float power_of_two_exactly(int n) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(n + 127) << 23);
}

/// 2^(n / 256), rounded up by a little; 2^-100 for less.
constexpr float power_of_two(int n_q8) {
    const int n = std::max(n_q8, -100 * 256);
    const int whole = n >> 8;
    return static_cast<float>(exp2_q16(n - whole * 256)) * 1.02F * power_of_two_exactly(whole - 16);
}

/// Contest::odds without a library's call.
float odds_of(const Contest& contest, int lost) {
    const int log2_q8 = std::max(contest.log2_odds_q8(lost), kNegligible_q8);
    const int whole = log2_q8 >> 8;
    return static_cast<float>(static_cast<std::int32_t>(exp2_q16(log2_q8 - whole * 256))) *
           power_of_two_exactly(whole - 16);
}

/// What adds up to less is as good as nothing, and slow to reckon with.
constexpr float kNothing = 1e-30F;

/// Something of every set of rivals, in whole vectors.
struct OfSets {
    std::array<Four, 2> part;

    static OfSets of(float value) { return {{Four{} + value, Four{} + value}}; }
};

/// The same in numbers.
using NumbersOfSets = std::array<float, 8>;
template <typename Number>
constexpr NumbersOfSets of_each_set(Number number) {
    NumbersOfSets numbers{};
    for (std::size_t i = 0; i < kRivalSets.size(); ++i)
        numbers[i] = number(kRivalSets[i]);
    return numbers;
}
constexpr NumbersOfSets kEqual =
    of_each_set([](const RivalSet& set) { return power_of_two(set.equal_q8 + kUnevenness_q8); });
constexpr NumbersOfSets kRivals =
    of_each_set([](const RivalSet& set) { return power_of_two(set.rivals_q8); });

/// The expectation of `quick_rivals.cpp` in floating point, for all sets at once: rivals that share
/// no line are lumped together, those that share the last ones counted by how many.
float far_rivals(const Contest& contest) {
    constexpr float kUnevenness = 1.03F;
    const int most = contest.most_shared();
    // Those that share the lines from one on, and none before it; nobody has before the first one.
    std::array<OfSets, kMostShared + kMaxLines> sharing;
    std::fill_n(sharing.begin(), kMostShared, OfSets::of(0));
    OfSets* newest = &sharing[kMostShared - 1];
    *newest = OfSets::of(1);
    OfSets apart = OfSets::of(kShifts * odds_of(contest, contest.least_loss(0)));
    OfSets sum;
    for (std::size_t i = 0; i < 2; ++i)
        sum.part[i] = apart.part[i] + newest->part[i];
    for (int line = 1; line < contest.lines.count(); ++line) {
        const float best = odds_of(contest, contest.least_loss(line));
        ++newest;
        for (std::size_t i = 0; i < 2; ++i) {
            const Four equally = four_at(&kEqual[4 * i]);
            newest->part[i] = apart.part[i] * equally;
            const Four by_one = (Four{} + best) * kUnevenness;
            const Four by_all = kShifts * best * equally;
            const Four now = sum.part[i] * (by_one < by_all ? by_one : by_all);
            apart.part[i] = now > kNothing ? now : Four{} + kNothing;
            Four all = apart.part[i] + newest->part[i];
            for (int n = 1; n < most; ++n) {
                Four& before = (newest - n)->part[i];
                before *= equally;
                all += before;
            }
            sum.part[i] = all;
        }
    }
    float all = 0;
    for (std::size_t i = 0; i < kRivalSets.size(); ++i)
        all += sum.part[i / 4][i % 4] * kRivals[i];
    return all;
}

/// The same position in other sections.
float other_sections(const Contest& contest) {
    int lost = 0;
    for (int line = 0; line < contest.lines.count(); ++line)
        lost += contest.least_loss(line);
    return kShifts * odds_of(contest, lost);
}

/// What every line costs at least who does not share it, the dearest first. Bits count alike here,
/// so losses are whole bits.
constexpr int kBit = 2 * 127;  // of score
std::size_t sort_losses(const Contest& contest, std::span<LineLoss> losses) {
    const auto count = static_cast<std::size_t>(contest.lines.count());
    for (std::size_t line = 0; line < count; ++line) {
        const int bits = std::max(contest.least_loss(static_cast<int>(line)), 0) / kBit;
        std::size_t i = line;
        for (; i > 0 && losses[i - 1].loss < bits; --i)
            losses[i] = losses[i - 1];
        losses[i] = {static_cast<std::uint8_t>(line), static_cast<std::uint8_t>(bits)};
    }
    return count;
}

/// What a position loses whose place differs in one sequence, and that shares a line.
int loss_of(const Contest& contest, std::size_t sequence, std::uint32_t place, int shared) {
    const std::uint8_t* own = contest.basis[sequence].rolls + contest.places[sequence];
    const std::uint8_t* rival = contest.basis[sequence].rolls + place;
    const int base = rival[shared] - own[shared];
    int lost = 0;
    for (int line = 0; line < contest.lines.count(); ++line) {
        int shift = rival[line] - own[line] - base;
        shift += shift < 0 ? kSections : 0;
        shift -= shift >= kSections ? kSections : 0;
        lost += contest.loss(line, shift < 0 ? shift + kSections : shift);
    }
    return lost;
}

/// Rivals that differ in one sequence: all that lose so little that they may count, one by one. 1
/// if there are too many.
float single_rivals(const Kernels& kernels, const Contest& contest) {
    std::array<LineLoss, kMaxLines> storage;
    const std::size_t lines = sort_losses(contest, storage);
    const int enough = (contest.loss_for(kPassedOver_q8) + contest.most_regained()) / kBit + 1;
    float sum = kSingles * kPassedOver * static_cast<float>(lines);
    SimilarPlaceList list;
    if (!kernels.list_similar_places(contest.basis, contest.places, std::span(storage).first(lines),
                                     enough, list)) {
        return 1;
    }
    for (const auto& [sequence, place, line] :
         std::span(list.places).first(static_cast<std::size_t>(list.count)))
        sum += odds_of(contest, loss_of(contest, sequence, place, line));
    return sum;
}

/// Probability that one axis is wrong; where it is above the limit, no more than that.
float axis_wrong(const Kernels& kernels, const Confidence& bits, const Lines& lines,
                 Profile profile, const AxisReading& reading, int odds_per_bit_q8, int limit_log2) {
    const float limit = std::ldexp(1.0F, limit_log2);
    const float chance = std::ldexp(1.0F, chance_log2(bits, odds_per_bit_q8));
    if (chance > limit || lines.count() <= kMostShared) return 1;
    const Contest contest(profile, lines, reading, odds_per_bit_q8);
    float sum =
        chance + far_rivals(contest) + other_sections(contest) + single_rivals(kernels, contest);
    if (sum > limit) sum = chance + power_of_two(quick_rivals_log2_q8(contest, 256 * limit_log2));
    if (sum > limit) sum = chance + std::ldexp(1.0F, rivals_log2(profile, contest, limit_log2));
    if (sum > limit) return 1;
    return sum + power_of_two(std::max(seam_rivals_log2_q8(kernels, contest), -100 * 256));
}

}  // namespace

bool is_certain(const Kernels& kernels, const Evidence& evidence, Profile profile,
                const IntegrityOptions& options, Fix& fix) {
    const auto& [x_bits, y_bits] = evidence.bits;
    fix.bit_errors = x_bits.wrong() + y_bits.wrong();
    for (const Confidence& bits : evidence.bits) {
        // Two patterns in view.
        if (256 * bits.wrong() > bits.bits() * options.max_bit_error_q8) return false;
    }
    // Both axes are read from the same dots, and so are misread alike.
    Confidence both = x_bits;
    both.add(y_bits);
    const int odds_q8 = odds_per_bit_q8(both);
    if (odds_q8 == 0) return false;
    const auto& [cell, section] = evidence.corner;
    const auto roll = [&](std::uint32_t position, int own_section, std::uint32_t cross) {
        return static_cast<std::uint8_t>(code::roll_from(profile, position, own_section, cross));
    };
    const AxisReading x{cell.x, roll(cell.x, section.u, cell.y), 0, 0};
    const AxisReading y{cell.y, roll(cell.y, section.v, cell.x), 0, 0};
    const int limit = options.max_p_wrong_log2;
    const float x_wrong = axis_wrong(kernels, x_bits, evidence.columns, profile, x, odds_q8, limit);
    if (x_wrong >= 1) return false;
    const float wrong =
        x_wrong + axis_wrong(kernels, y_bits, evidence.rows, profile, y, odds_q8, limit);
    int exponent = 0;
    std::frexp(wrong, &exponent);  // wrong < 2^exponent
    fix.p_wrong_log2 = std::min(exponent, 0);
    return fix.p_wrong_log2 <= limit;
}

}  // namespace dotpose::core

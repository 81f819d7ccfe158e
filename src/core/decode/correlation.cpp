#include "core/decode/correlation.hpp"

#include <utility>

#include "code/sequences.hpp"

namespace dotpose::core {
namespace {

/// The weights of a line are processed in groups of kGroup. For each group, a table contains the
/// sum of the weights for every combination of signs, so scoring a roll takes one addition per
/// group instead of one per weight. Up to kGroups groups are added in one pass over the rolls.
constexpr std::size_t kGroup = 5;
constexpr std::size_t kGroups = 4;
constexpr std::size_t kAtOnce = kGroup * kGroups;
/// Weights of two lines a and b, packed as a + 65536 b. The sums of each line fit in 16 bits, so
/// one addition is enough for both lines.
using Weights = std::array<std::int32_t, kAtOnce>;
using Sums = std::array<std::int32_t, 1 << kGroup>;

/// Strings of kGroup bits in the main sequence, by start index. The first bit is the lowest bit.
/// The strings are stored as byte offsets into Sums, to save a multiplication on small processors.
constexpr auto kStrings = [] {
    std::array<std::uint8_t, 2 * kSections + kAtOnce> strings{};
    for (std::size_t i = 0; i < strings.size(); ++i) {
        for (std::size_t k = 0; k < kGroup; ++k) {
            const std::size_t bit = code::kMain[(i + k) % kSections] * sizeof(std::int32_t) << k;
            strings[i] = static_cast<std::uint8_t>(strings[i] | bit);
        }
    }
    return strings;
}();

std::int32_t sum_at(const Sums& sums, std::uint8_t bytes) {
    const void* first = sums.data();
    const void* sum = static_cast<const std::byte*>(first) + bytes;
    return *static_cast<const std::int32_t*>(sum);
}

using Line = std::span<const std::int8_t>;

/// Packs kAtOnce weights of each line, starting at index `first`. Weights beyond the end of a line
/// are 0.
void gather(Line a, Line b, std::size_t first, Weights& weights) {
    const auto rest = [&](Line line) {
        line = line.subspan(std::min(first, line.size()));
        return line.first(std::min(line.size(), kAtOnce));
    };
    std::int32_t* weight = weights.data();
    for (const std::int8_t of_a : rest(a))
        *weight++ = of_a;
    std::fill(weight, weights.data() + weights.size(), 0);
    weight = weights.data();
    for (const std::int8_t of_b : rest(b))
        *weight++ += of_b * 65536;
}

template <std::size_t... I>
void append_sums(Sums& sums, std::int32_t weight, std::index_sequence<I...>) {
    ((sums[sizeof...(I) + I] = sums[I] + 2 * weight), ...);
}

/// Computes the signed sum of a group of weights for each string of kGroup bits. A 0 bit negates
/// the corresponding weight. The loop over the weights is unrolled, which halves the time. The
/// function is not inlined, because the unrolled code is too long.
[[gnu::noinline]] void sum_signed(const std::int32_t* weights, Sums& sums) {
    static_assert(kGroup == 5);
    sums[0] = -(weights[0] + weights[1] + weights[2] + weights[3] + weights[4]);
    append_sums(sums, weights[0], std::make_index_sequence<1>{});
    append_sums(sums, weights[1], std::make_index_sequence<2>{});
    append_sums(sums, weights[2], std::make_index_sequence<4>{});
    append_sums(sums, weights[3], std::make_index_sequence<8>{});
    append_sums(sums, weights[4], std::make_index_sequence<16>{});
}

/// Adds the group sums to the score of each roll, or overwrites the scores if `Adds` is false.
/// `phase` is the index of the first weight in its line, modulo 63.
template <std::size_t Groups, bool Adds>
void take_sums(const std::array<Sums, kGroups>& sums, std::size_t phase, LineScores& scores_a,
               LineScores& scores_b) {
    const std::uint8_t* string = kStrings.data() + phase;
    std::int16_t* a = scores_a.data();
    std::int16_t* b = scores_b.data();
    for (const std::uint8_t* end = string + kSections; string != end; ++string, ++a, ++b) {
        std::int32_t sum = sum_at(sums[0], string[0]);
        for (std::size_t group = 1; group < Groups; ++group)
            sum += sum_at(sums[group], string[group * kGroup]);
        // Unpacks the sum of line b. (sum + 0x8000) >> 16 would give the same result, but its
        // constant would occupy a register.
        const std::int32_t of_b = ((sum >> 15) + 1) >> 1;
        *a = static_cast<std::int16_t>(Adds ? *a + sum : sum);
        *b = static_cast<std::int16_t>(Adds ? *b + of_b : of_b);
    }
}

}  // namespace

void correlate_both(Line a, Line b, LineScores& scores_a, LineScores& scores_b) {
    const auto are_zero = [&](std::size_t i) {
        return (i >= a.size() || a[i] == 0) && (i >= b.size() || b[i] == 0);
    };
    // Skips empty cells at both ends, because most lines of a rotated grid have such cells.
    std::size_t end = std::max(a.size(), b.size());
    std::size_t first = 0;
    while (first < end && are_zero(first))
        ++first;
    while (end > first && are_zero(end - 1))
        --end;
    const std::size_t groups = end - first <= 3 * kGroup ? 3 : kGroups;
    auto take = groups == 3 ? take_sums<3, false> : take_sums<kGroups, false>;
    std::size_t phase = first;
    do {
        Weights weights;
        gather(a, b, first, weights);
        std::array<Sums, kGroups> sums;
        for (std::size_t group = 0; group < groups; ++group)
            sum_signed(&weights[group * kGroup], sums[group]);
        while (phase >= kSections)
            phase -= kSections;
        take(sums, phase, scores_a, scores_b);
        take = take_sums<kGroups, true>;
        first += kAtOnce;
        phase += kAtOnce;
    } while (first < end);
}

void correlate(std::span<const std::int8_t> weights, LineScores& scores) {
    LineScores none;
    correlate_both(weights, {}, scores, none);
}

// The unrolled code is too long to inline.
[[gnu::noinline]] Match next_match(const LineScores& scores, Match last) {
    std::int32_t best = INT32_MIN;
    std::size_t roll = 0;
#pragma GCC unroll 7
    for (std::size_t o = 0; o < scores.size(); ++o) {
        const std::int32_t score = scores[o];
        if (score <= best || score > last.score) continue;
        if (score == last.score && o <= last.roll) continue;
        best = score;
        roll = o;
    }
    return {best, static_cast<std::uint8_t>(roll)};
}

Match best_match(const LineScores& scores) {
    return next_match(scores, {INT32_MAX, 0});
}

BestScore best_score(const LineScores& scores) {
    std::int32_t best = INT16_MIN;
    std::int32_t second = INT16_MIN;
#pragma GCC unroll 7
    for (const std::int32_t score : scores) {
        if (score <= second) continue;
        second = std::min(best, score);
        best = std::max(best, score);
    }
    return {static_cast<std::int16_t>(best), static_cast<std::int16_t>(best - second)};
}

Extremes extremes_of(const LineScores& scores) {
    std::int32_t max = scores[0];
    std::int32_t min = scores[0];
#pragma GCC unroll 7
    for (const std::int32_t score : scores) {
        if (score > max) max = score;
        if (score < min) min = score;
    }
    return {max, min};
}

}  // namespace dotpose::core

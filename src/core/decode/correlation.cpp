#include "core/decode/correlation.hpp"

#include "code/sequences.hpp"

namespace dotpose::core {
namespace {

/// So many weights are summed at a time, in all combinations of signs, and so many such groups.
constexpr std::size_t kGroup = 5;
constexpr std::size_t kGroups = 4;
constexpr std::size_t kAtOnce = kGroup * kGroups;
/// Weights of two lines, or sums of them, at once: they fit 16 bits, so a + 65536 b adds up like
/// one number.
using Weights = std::array<std::int32_t, kAtOnce>;
using Sums = std::array<std::int32_t, 1 << kGroup>;

/// The `kGroup` bits of the main sequence that follow any index, the first in the lowest.
constexpr auto kStrings = [] {
    std::array<std::uint8_t, 2 * kSections + kAtOnce> strings{};
    for (std::size_t i = 0; i < strings.size(); ++i) {
        for (std::size_t k = 0; k < kGroup; ++k) {
            strings[i] =
                static_cast<std::uint8_t>(strings[i] | code::kMain[(i + k) % kSections] << k);
        }
    }
    return strings;
}();

using Line = std::span<const std::int8_t>;

/// Both lines' weights from `first` on, 0 where they have ended.
void gather(Line a, Line b, std::size_t first, Weights& weights) {
    const auto end_of = [&](Line line) {
        return std::min(std::max(line.size(), first), first + kAtOnce);
    };
    weights.fill(0);
    std::int32_t* weight = weights.data();
    for (std::size_t i = first; i < end_of(a); ++i)
        *weight++ = a[i];
    weight = weights.data();
    for (std::size_t i = first; i < end_of(b); ++i)
        *weight++ += b[i] * 65536;
}

/// For each string of bits the sum of a group of weights, negative where the bit is 0.
// By itself, as it is long: without loops it takes half of the time.
[[gnu::noinline]] void sum_signed(const std::int32_t* weights, Sums& sums) {
    sums[0] = -(weights[0] + weights[1] + weights[2] + weights[3] + weights[4]);
    std::size_t count = 1;
#pragma GCC unroll 5
    for (std::size_t k = 0; k < kGroup; ++k) {
        const std::int32_t twice = 2 * weights[k];
#pragma GCC unroll 16
        for (std::size_t i = 0; i < count; ++i)
            sums[count + i] = sums[i] + twice;
        count *= 2;
    }
}

/// Adds the sums of all groups to the scores, or sets the scores to them.
template <std::size_t Groups, bool Adds>
void take_sums(const std::array<Sums, kGroups>& sums, std::size_t phase, LineScores& scores_a,
               LineScores& scores_b) {
    const std::uint8_t* string = kStrings.data() + phase;
    for (std::size_t o = 0; o < kSections; ++o, ++string) {
        std::int32_t sum = sums[0][string[0]];
        for (std::size_t group = 1; group < Groups; ++group)
            sum += sums[group][string[group * kGroup]];
        const std::int32_t of_b = (sum + 0x8000) >> 16;
        scores_a[o] = static_cast<std::int16_t>(Adds ? scores_a[o] + sum : sum);
        scores_b[o] = static_cast<std::int16_t>(Adds ? scores_b[o] + of_b : of_b);
    }
}

}  // namespace

void correlate_both(Line a, Line b, LineScores& scores_a, LineScores& scores_b) {
    const auto are_zero = [&](std::size_t i) {
        return (i >= a.size() || a[i] == 0) && (i >= b.size() || b[i] == 0);
    };
    // Lines of a grid that stands askew in the image are empty at both ends.
    std::size_t end = std::max(a.size(), b.size());
    std::size_t first = 0;
    while (first < end && are_zero(first))
        ++first;
    while (end > first && are_zero(end - 1))
        --end;
    auto take = end - first <= 3 * kGroup ? take_sums<3, false> : take_sums<kGroups, false>;
    std::size_t phase = first;
    do {
        Weights weights;
        gather(a, b, first, weights);
        std::array<Sums, kGroups> sums;
        for (std::size_t group = 0; group < kGroups; ++group)
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

Match best_match(const LineScores& scores) {
    Match best{scores[0], 0};
    for (std::size_t o = 1; o < scores.size(); ++o) {
        if (scores[o] > best.score) best = {scores[o], static_cast<std::uint8_t>(o)};
    }
    return best;
}

}  // namespace dotpose::core

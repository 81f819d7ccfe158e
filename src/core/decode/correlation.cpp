#include "core/decode/correlation.hpp"

#include "code/sequences.hpp"

namespace dotpose::core {
namespace {

/// So many weights are summed at a time, in all combinations of signs, and so many such groups.
constexpr std::size_t kGroup = 4;
constexpr std::size_t kGroups = 3;
/// Of two lines at once: their sums fit 16 bits, so a + 65536 b adds up like one number.
using Sums = std::array<std::int32_t, 1 << kGroup>;

/// The `kGroup` bits of the main sequence that follow any index, the first in the lowest.
constexpr auto kStrings = [] {
    std::array<std::uint8_t, 2 * kSections + kGroup * kGroups> strings{};
    for (std::size_t i = 0; i < strings.size(); ++i) {
        for (std::size_t k = 0; k < kGroup; ++k) {
            strings[i] =
                static_cast<std::uint8_t>(strings[i] | code::kMain[(i + k) % kSections] << k);
        }
    }
    return strings;
}();

/// The weights of two lines, side by side.
struct Pair {
    std::span<const std::int8_t> a;
    std::span<const std::int8_t> b;

    std::int32_t operator[](std::size_t i) const {
        return (i < a.size() ? a[i] : 0) + (i < b.size() ? b[i] : 0) * 65536;
    }
};

/// For each string of bits the sum of the weights from `first` on, negative where the bit is 0.
void sum_signed(const Pair& weights, std::size_t first, Sums& sums) {
    const std::array<std::int32_t, kGroup> w{weights[first], weights[first + 1], weights[first + 2],
                                             weights[first + 3]};
    sums[0] = -(w[0] + w[1] + w[2] + w[3]);
    for (std::size_t k = 0, count = 1; k < kGroup; ++k, count *= 2) {
        for (std::size_t i = 0; i < count; ++i)
            sums[count + i] = sums[i] + 2 * w[k];
    }
}

}  // namespace

void correlate_both(std::span<const std::int8_t> a, std::span<const std::int8_t> b,
                    LineScores& scores_a, LineScores& scores_b) {
    const Pair weights{a, b};
    // Lines of a grid that stands askew in the image are empty at both ends.
    std::size_t end = std::max(a.size(), b.size());
    std::size_t first = 0;
    while (first < end && weights[first] == 0)
        ++first;
    while (end > first && weights[end - 1] == 0)
        --end;
    std::size_t phase = first % kSections;
    std::array<Sums, kGroups> sums;
    scores_a.fill(0);
    scores_b.fill(0);
    for (; first < end; first += kGroups * kGroup) {
        for (std::size_t group = 0; group < kGroups; ++group)
            sum_signed(weights, first + group * kGroup, sums[group]);
        const std::uint8_t* string = kStrings.data() + phase;
        for (std::size_t o = 0; o < kSections; ++o, ++string) {
            const std::int32_t sum =
                sums[0][string[0]] + sums[1][string[kGroup]] + sums[2][string[2 * kGroup]];
            const auto of_a = static_cast<std::int16_t>(sum);
            scores_a[o] = static_cast<std::int16_t>(scores_a[o] + of_a);
            scores_b[o] = static_cast<std::int16_t>(scores_b[o] + ((sum - of_a) >> 16));
        }
        phase = (phase + kGroups * kGroup) % kSections;
    }
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

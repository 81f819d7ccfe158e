#include "core/decode/eight_lines.hpp"

#include <algorithm>

#include "code/sequences.hpp"

namespace dotpose::core {
namespace {

/// So many weights are summed at a time, in all combinations of signs, and so many such groups.
constexpr std::size_t kGroup = 5;
constexpr std::size_t kGroups = 4;
constexpr std::size_t kAtOnce = kGroup * kGroups;
using Sums = std::array<Eight, 1 << kGroup>;

/// The `kGroup` bits of the main sequence that follow any index, the first in the lowest: as a
/// distance in bytes in Sums.
constexpr auto kStrings = [] {
    std::array<std::uint16_t, 2 * kSections + kAtOnce> strings{};
    for (std::size_t i = 0; i < strings.size(); ++i) {
        for (std::size_t k = 0; k < kGroup; ++k) {
            const std::size_t bit = code::kMain[(i + k) % kSections] * sizeof(Eight) << k;
            strings[i] = static_cast<std::uint16_t>(strings[i] | bit);
        }
    }
    return strings;
}();

const Eight& sum_at(const Sums& sums, std::uint16_t bytes) {
    const void* first = sums.data();
    const void* sum = static_cast<const std::byte*>(first) + bytes;
    return *static_cast<const Eight*>(sum);
}

/// For each string of bits the sum of a group of weights, negative where the bit is 0.
void sum_signed(const Eight* weights, Sums& sums) {
    sums[0] = -(weights[0] + weights[1] + weights[2] + weights[3] + weights[4]);
#pragma GCC unroll 8
    for (std::size_t k = 0; k < kGroup; ++k) {
        const std::size_t half = std::size_t{1} << k;
        const Eight twice = weights[k] + weights[k];
#pragma GCC unroll 16
        for (std::size_t i = 0; i < half; ++i)
            sums[half + i] = sums[i] + twice;
    }
}

/// Adds the sums of all groups to the scores, or sets the scores to them.
template <std::size_t Groups, bool Adds>
void take_sums(const std::array<Sums, kGroups>& sums, std::size_t phase, EightScores& scores) {
    const std::uint16_t* string = kStrings.data() + phase;
    for (Eight& score : scores) {
        Eight sum = sum_at(sums[0], string[0]);
        for (std::size_t group = 1; group < Groups; ++group)
            sum += sum_at(sums[group], string[group * kGroup]);
        score = Adds ? score + sum : sum;
        ++string;
    }
}

/// Eight vectors into those of their first numbers, of their second numbers, and so on.
void transpose(std::array<Eight, 8>& rows) {
    std::array<Eight, 8> other;
    const auto interleave = [](const std::array<Eight, 8>& from, std::array<Eight, 8>& to) {
        for (std::size_t i = 0; i < 4; ++i) {
            const Eight a = from[i];
            const Eight b = from[i + 4];
            to[2 * i] = __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
            to[2 * i + 1] = __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
        }
    };
    interleave(rows, other);
    interleave(other, rows);
    interleave(rows, other);
    rows = other;
}

}  // namespace

void correlate_eight(const EightWeights& weights, std::size_t length, EightScores& scores) {
    const std::size_t groups = length <= 3 * kGroup ? 3 : kGroups;
    auto take = groups == 3 ? take_sums<3, false> : take_sums<kGroups, false>;
    std::size_t phase = 0;
    for (std::size_t first = 0; first < length; first += kAtOnce) {
        std::array<Eight, kAtOnce> some{};
        std::copy_n(&weights[first], std::min(length - first, kAtOnce), some.begin());
        std::array<Sums, kGroups> sums;
        for (std::size_t group = 0; group < groups; ++group)
            sum_signed(&some[group * kGroup], sums[group]);
        take(sums, phase, scores);
        take = take_sums<kGroups, true>;
        phase = (phase + kAtOnce) % kSections;
    }
}

void write_scores(const EightScores& scores, std::span<ScoredLine> lines) {
    constexpr std::size_t kLast = kSections - 8;
    for (std::size_t first = 0; first < kSections; first += 8) {
        // The last eight overlap those before them.
        const std::size_t offset = std::min(first, kLast);
        std::array<Eight, 8> by_line;
        std::copy_n(scores.begin() + offset, by_line.size(), by_line.begin());
        transpose(by_line);
        for (std::size_t i = 0; i < lines.size(); ++i)
            std::memcpy(&lines[i].scores[offset], &by_line[i], sizeof(Eight));
    }
}

}  // namespace dotpose::core

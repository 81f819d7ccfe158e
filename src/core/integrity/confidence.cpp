#include "core/integrity/confidence.hpp"

#include <algorithm>

#include "core/math/fixed.hpp"

namespace dotpose::core {
namespace {

/// log2(1 + 2^-n) in units of 2^-16, for n = 0, 1/2, 1, ..., rounded up.
constexpr std::array<std::int32_t, 34> kLog2OfOneAnd{
    65536, 50565, 38337, 28623, 21098, 15391, 11137, 8009, 5732, 4089, 2910, 2067,
    1466,  1039,  736,   521,   369,   261,   185,   131,  93,   66,   47,   33,
    24,    17,    12,    9,     6,     5,     3,     3,    2,    2};

/// Returns an upper bound on log2(1 + 2^-n), in units of 2^-16. The function is convex, so linear
/// interpolation in the table gives an upper bound.
int log2_of_one_and_q16(int n_q8) {
    const auto i = static_cast<std::size_t>(n_q8 >> 7);
    return kLog2OfOneAnd[i] - ((kLog2OfOneAnd[i] - kLog2OfOneAnd[i + 1]) * (n_q8 & 127) >> 7);
}

/// Returns the odds that a bit of the given level is correct, as log2 in units of 2^-8.
int log_odds_q8(int odds_per_bit_q8, int level) {
    // 129 / 2^14 is about 1 / 127.
    return (odds_per_bit_q8 * Confidence::weight_of(level) * 129) >> 14;
}

/// Returns the expected fraction of wrong bits at the given odds, in units of 2^-16.
std::uint32_t wrong_fraction_q16(int log_odds_q8) {
    if (log_odds_q8 >= 15 * 256) return 1;
    return UINT32_MAX / (65536 + static_cast<std::uint32_t>(exp2_q16(log_odds_q8)));
}

/// Returns the margin that is added to the observed weight of wrong bits, in units of 2^-16. The
/// margin is the weight of two hard bits. If the error rate is known, the margin is divided among
/// the bits of this frame and 2 (bits_per_error - 1) earlier bits, and the result is the part of
/// this frame. `weight` is the total weight of the bits of this frame.
std::uint32_t margin_q16(std::uint32_t weight, int bits_per_error) {
    constexpr std::uint32_t kMargin = 2 * 127;
    if (bits_per_error <= 1) return kMargin << 16;
    // At the known rate, 2 * bits_per_error bits contain two errors. Two bits are subtracted to
    // make bits_per_error = 1 equivalent to an unknown rate.
    const std::uint32_t earlier = 2 * (static_cast<std::uint32_t>(bits_per_error) - 1);
    const std::uint32_t bits = weight / 127;
    const std::uint32_t fraction_q12 = (bits << 12) / (bits + earlier) + 1;
    return kMargin * fraction_q12 << 4;
}

/// Returns the Chernoff bound on the probability that random bits agree with a given place at least
/// as well as the bits that were read, as log2 in units of 2^-16.
std::int64_t agreement_log2_q16(const Confidence& axis, int odds_per_bit_q8) {
    std::int64_t sum_q16 = 0;
    for (int level = 0; level < Confidence::kLevels; ++level) {
        const int bits = axis.bits(level);
        if (bits == 0) continue;
        const int y_q8 = log_odds_q8(odds_per_bit_q8, level);
        sum_q16 += std::int64_t{bits} * (log2_of_one_and_q16(y_q8) - 65536) +
                   std::int64_t{axis.wrong(level)} * (y_q8 * 256);
    }
    return sum_q16;
}

}  // namespace

int odds_per_bit_q8(const Confidence& confidence, int bits_per_error) {
    struct Weighted {
        std::uint8_t level;
        std::uint32_t weight;  ///< total weight of the level's bits
    };
    std::array<Weighted, Confidence::kLevels> levels;
    std::size_t count = 0;
    std::uint32_t wrong = 0;
    std::uint32_t total = 0;
    for (int level = Confidence::kLevels; level-- > 0;) {
        const int bits = confidence.bits(level);
        if (bits == 0) continue;
        const int weight = Confidence::weight_of(level);
        levels[count++] = {static_cast<std::uint8_t>(level),
                           static_cast<std::uint32_t>(bits * weight)};
        total += static_cast<std::uint32_t>(bits * weight);
        wrong += static_cast<std::uint32_t>(weight * confidence.wrong(level));
    }
    const std::uint64_t allowed_q16 =
        (std::uint64_t{wrong} << 16) + margin_q16(total, bits_per_error);
    int odds_q8 = 0;
    // Finds the odds by bisection. This is possible because the expected weight of wrong bits
    // decreases as the odds increase.
    for (int step_q8 = 8 * 256; step_q8 >= 8; step_q8 /= 2) {
        std::uint64_t expected_q16 = 0;
        for (std::size_t i = 0; i < count && expected_q16 <= allowed_q16; ++i) {
            const auto [level, weight] = levels[i];
            expected_q16 +=
                std::uint64_t{weight} * wrong_fraction_q16(log_odds_q8(odds_q8 + step_q8, level));
        }
        if (expected_q16 > allowed_q16) odds_q8 += step_q8;
    }
    return odds_q8;
}

int agreement_log2_q8(const Confidence& bits, int odds_per_bit_q8) {
    constexpr int kBeyondDoubt_q8 = 16 * 256;
    const std::int64_t best_q16 = std::min(agreement_log2_q16(bits, odds_per_bit_q8),
                                           agreement_log2_q16(bits, kBeyondDoubt_q8));
    return static_cast<int>(best_q16 >> 8) + 1;
}

int chance_log2_q8(const Confidence& axis, int odds_per_bit_q8, int log2_times_q8) {
    // log2(410,815,348 positions * 63 sections * 4 orientations) = 36.59, rounded up.
    constexpr int kHypotheses_q8 = 9368;
    return agreement_log2_q8(axis, odds_per_bit_q8) + kHypotheses_q8 + log2_times_q8;
}

int chance_log2(const Confidence& axis, int odds_per_bit_q8) {
    // Rounds log2 of the number of hypotheses, 36.59, up to 37.
    const std::int64_t sum_q16 = 37 * 65536 + agreement_log2_q16(axis, odds_per_bit_q8);
    return static_cast<int>(std::min<std::int64_t>(sum_q16 >> 16, 36)) + 1;
}

}  // namespace dotpose::core

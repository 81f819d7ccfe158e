#include "core/decode/confidence.hpp"

#include <algorithm>

#include "core/fixed.hpp"

namespace dotpose::core {
namespace {

/// log2(1 + 2^-n) in 2^-16, at most 3 % too large.
std::int64_t log2_of_one_and_q16(int n_q8) {
    const std::int64_t part_q16 = (std::int64_t{1} << 32) / exp2_q16(n_q8);
    return log2_q16(static_cast<std::uint32_t>(65536 + part_q16 + part_q16 / 48 + 1)) - 16 * 65536 +
           1;
}

}  // namespace

int odds_per_bit_q8(const Confidence& confidence) {
    const int allowed = confidence.wrong_weight() + 2 * 127;
    int odds_q8 = 0;
    // Bisection: the larger the odds, the less is expected to be wrong.
    for (int step_q8 = 8 * 256; step_q8 > 0; step_q8 /= 2) {
        std::int64_t expected_q16 = 0;
        for (int weight = 1; weight <= Confidence::kMostWeight; ++weight) {
            const int bits = confidence.bits(weight);
            if (bits == 0) continue;
            const int log_odds_q8 = (odds_q8 + step_q8) * weight / 127;
            const std::int64_t wrong_q16 =
                (std::int64_t{1} << 32) / (65536 + exp2_q16(log_odds_q8));
            expected_q16 += bits * weight * wrong_q16;
        }
        if (expected_q16 > std::int64_t{allowed} << 16) odds_q8 += step_q8;
    }
    return odds_q8;
}

int chance_log2(const Confidence& axis, int odds_per_bit_q8) {
    // log2(410815348 * 63 * 4) = 36.6
    std::int64_t sum_q16 = 37 * 65536;
    for (int weight = 1; weight <= Confidence::kMostWeight; ++weight) {
        const int bits = axis.bits(weight);
        if (bits == 0) continue;
        const int log_odds_q8 = odds_per_bit_q8 * weight / 127;
        sum_q16 += bits * (log2_of_one_and_q16(log_odds_q8) - 65536) +
                   std::int64_t{axis.wrong(weight)} * log_odds_q8 * 256;
    }
    return static_cast<int>(std::min<std::int64_t>(sum_q16 >> 16, 36)) + 1;
}

}  // namespace dotpose::core

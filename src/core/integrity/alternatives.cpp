#include "core/integrity/alternatives.hpp"

#include <algorithm>
#include <cmath>

#include "core/integrity/double_alternatives.hpp"
#include "core/integrity/expected_alternatives.hpp"
#include "core/integrity/likely_alternatives.hpp"
#include "core/integrity/near_alternatives.hpp"
#include "core/integrity/ranked_lines.hpp"
#include "core/integrity/single_alternatives.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// Maximum number of adjacent lines that two positions can share in `anoto` and `microdots`. Two
/// positions that share six adjacent lines would be equal, because they would have five equal
/// digits in each sequence, and five digits determine a place. In `libdots`, some positions share
/// more lines. The near alternatives include these positions.
constexpr int kMaxSharedInARow = code::kOrder;
/// The far alternatives are evaluated in detail only if their expected odds are below this value.
/// If the expected odds are larger, a detailed evaluation is unlikely to make the fix certain.
constexpr float kMaxOddsForDetail = 1e-4F;
/// Default limit on the summed odds.
constexpr float kUsualLimit = 0x1p-30F;

/// Returns the summed odds of the reading's position in all other sections. In each of these
/// sections, the rolls of all lines differ from the rolls of the reading by the same shift.
float sum_of_other_sections(const RankedLines& lines) {
    float sum = 0;
    for (int shift = 1; shift < kSections; ++shift) {
        int lost = 0;
        for (int line = 0; line < lines.count(); ++line)
            lost += lines.loss(line, shift);
        sum += lines.ratios.odds(lost);
    }
    return sum;
}

int log2_rounded_up(float sum) {
    if (sum >= 1) return 0;  // including infinity
    int exponent = 0;
    std::frexp(sum, &exponent);  // sum < 2^exponent
    return exponent;
}

/// Expected total odds of the far alternatives. The expectation is over all places.
struct Expectation {
    float of_two;   ///< alternatives that differ in two sequences
    float of_more;  ///< alternatives that differ in three or four sequences
};

/// Returns the summed odds of all alternatives. `known` is the sum of the odds of the single
/// alternatives, the other sections, and the near alternatives that share kMaxSharedInARow lines.
/// The function adds the odds of the remaining alternatives. Double alternatives, and near
/// alternatives that share kMaxSharedInARow - 1 lines, are counted one by one, because their true
/// odds may exceed their expected odds. Expected odds replace only sums that are negligible, or
/// that would take too long to compute. Stops when the sum reaches `limit`.
float counted_in_detail(const Kernels& kernels, const RankedLines& lines, float known,
                        Expectation expected, float limit) {
    // The smaller of the caller's limit and the default limit. A sum is negligible if it is small
    // relative to this value.
    const float usual = std::min(limit, kUsualLimit);
    float sum = kMargin * expected.of_more;
    if (sum > usual / 16) {
        sum = sum_of_expected_alternatives(kernels, lines, kMaxSharedInARow - 2, 3, 4);
        // Skips the slowest sum if the other sums already exceed the limit.
        if (known + sum < limit)
            sum += sum_of_near_alternatives(kernels, lines, kMaxSharedInARow - 1);
    }
    sum += known;
    if (sum >= limit) return sum;
    // Limit on the expected odds of the double alternatives that are not counted one by one. It is
    // at most an eighth of the difference between `limit` and the sum so far, so the expected odds
    // alone normally do not raise the sum to `limit`.
    const float negligible = std::min(sum < usual / 8 ? usual / 16 : sum / 8, (limit - sum) / 8);
    return sum +
           sum_of_double_alternatives(kernels, lines, expected.of_two, negligible, limit - sum);
}

}  // namespace

float sum_of_alternatives(const Kernels& kernels, const LikelihoodRatios& ratios, int limit_log2) {
    if (ratios.lines.count() <= kMaxSharedInARow) return 1;
    const RankedLines lines(ratios);
    const float limit = power_of_two_exactly(limit_log2);
    // Computes the cheapest sums first, and stops when their total exceeds the limit.
    float known = sum_of_single_alternatives(kernels, lines) + sum_of_other_sections(lines);
    if (known >= limit) return known;
    const float max_rest = std::min(limit, kUsualLimit) / 4;
    if (const auto others = sum_of_likely_alternatives(kernels, lines, max_rest, limit - known))
        return known + *others;
    const auto expected_of = [&](int min_different, int max_different) {
        return sum_of_expected_alternatives(kernels, lines, kMaxSharedInARow - 1, min_different,
                                            max_different);
    };
    const Expectation expected{expected_of(2, 2), expected_of(3, 4)};
    const float far = expected.of_two + expected.of_more;
    if (far >= std::max(limit, kMaxOddsForDetail)) return far;
    known += sum_of_near_alternatives(kernels, lines, kMaxSharedInARow);
    const float sum = known + far;
    const bool needs_detail =
        sum > std::min(limit, kUsualLimit) / 1024 && far > known && far < kMaxOddsForDetail;
    if (known >= limit || !needs_detail) return sum;
    return counted_in_detail(kernels, lines, known, expected, limit);
}

int alternatives_log2(const Kernels& kernels, const LikelihoodRatios& ratios, int limit_log2) {
    return log2_rounded_up(sum_of_alternatives(kernels, ratios, limit_log2));
}

}  // namespace dotpose::core

#include "core/integrity/alternatives.hpp"

#include <algorithm>
#include <cmath>

#include "core/integrity/double_alternatives.hpp"
#include "core/integrity/expected_alternatives.hpp"
#include "core/integrity/near_alternatives.hpp"
#include "core/integrity/ranked_lines.hpp"
#include "core/integrity/single_alternatives.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {
namespace {

/// Maximum number of adjacent lines that two positions share in `anoto` and `microdots`. With six
/// shared lines, five digits would be equal in each sequence, and five digits determine a place. In
/// `libdots`, some positions share more lines. The near alternatives include these positions.
constexpr int kMaxSharedInARow = code::kOrder;
/// Maximum expected odds of the far alternatives for which a detailed evaluation is worth the time.
/// With larger expected odds, the fix cannot become certain.
constexpr float kBeyondHelp = 1e-4F;

/// Returns the expected odds of far alternatives. Includes alternatives that differ in at least
/// `min_different` sequences and share fewer than `shared_lines` adjacent lines.
float sum_of_far_alternatives(const RankedLines& lines, int shared_lines, int min_different) {
    ExpectedAlternatives expected(lines.ratios.basis, lines.ratios.position, shared_lines - 1,
                                  min_different);
    for (int line = 0; line < lines.count(); ++line)
        expected.add_line(lines.odds(line));
    return expected.sum();
}

/// Returns the summed odds of the other sections at the same position. In another section, all
/// rolls differ by the same shift.
float sum_of_other_sections(const LikelihoodRatios& ratios) {
    float sum = 0;
    for (int shift = 1; shift < kSections; ++shift) {
        int lost = 0;
        for (int line = 0; line < ratios.lines.count(); ++line)
            lost += ratios.loss(line, shift);
        sum += ratios.odds(lost);
    }
    return sum;
}

}  // namespace

int alternatives_log2(const LikelihoodRatios& ratios, int limit_log2) {
    if (ratios.lines.count() <= kMaxSharedInARow) return 0;
    const RankedLines lines(ratios);
    const float known = sum_of_single_alternatives(lines) + sum_of_other_sections(ratios) +
                        sum_of_near_alternatives(lines, kMaxSharedInARow);
    const float expected = sum_of_far_alternatives(lines, kMaxSharedInARow, 2);
    float sum = known + expected;
    const float limit = std::ldexp(1.0F, limit_log2);
    const float far_below_doubt = std::ldexp(1.0F, std::min(limit_log2, -30) - 10);
    // Evaluates more alternatives one by one: double alternatives, and near alternatives with one
    // shared line fewer. A smaller part of the sum is then only an expectation.
    if (sum > far_below_doubt && expected > known && expected < kBeyondHelp) {
        sum = known + sum_of_far_alternatives(lines, kMaxSharedInARow - 1, 3);
        // Skips the slowest sums if the limit is already exceeded.
        if (sum < limit) sum += sum_of_near_alternatives(lines, kMaxSharedInARow - 1);
        if (sum < limit) {
            // Maximum expected odds of the double alternatives that are not evaluated one by one.
            // An expectation alone must not cause a refusal, so the maximum is at most an eighth of
            // the margin to the limit.
            const float negligible = std::min(std::max(sum, far_below_doubt), limit - sum) / 8;
            sum += sum_of_double_alternatives(lines, negligible, limit - sum);
        }
    }
    int exponent = 0;
    std::frexp(sum, &exponent);  // sum < 2^exponent
    return std::min(exponent, 0);
}

}  // namespace dotpose::core

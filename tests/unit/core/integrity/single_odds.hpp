// Sum of the odds of all single alternatives, for tests of sums over alternatives.
#pragma once

#include <cmath>

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core_test {

using namespace core;

/// Calls `use(place, offsets, shift)` for each alternative that differs only in sequence k. The
/// roll offset of the alternative in a line is `offsets[line] - shift`.
template <typename Use>
void visit_single_alternatives(const LikelihoodRatios& ratios, std::size_t k, Use use) {
    for (std::uint32_t place = 0; place < ratios.basis[k].length; ++place) {
        if (place == ratios.places[k]) continue;
        RollOffsets offsets;
        set_roll_offsets(ratios, k, place, offsets);
        for (int shift = 0; shift < kSections; ++shift)
            use(place, offsets, shift);
    }
}

/// Returns the sum of the odds of all alternatives that differ in one sequence.
inline double single_odds(const LikelihoodRatios& ratios) {
    double sum = 0;
    for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
        visit_single_alternatives(
            ratios, k, [&](std::uint32_t, const RollOffsets& offsets, int shift) {
                int lost = 0;
                for (int line = 0; line < ratios.count(); ++line) {
                    const int shifted = offsets[static_cast<std::size_t>(line)] - shift;
                    lost += ratios.loss(line, shifted);
                }
                sum += std::exp2(ratios.log2_odds_q8(lost) / 256.0);
            });
    }
    return sum;
}

}  // namespace dotpose::core_test

#include "core/integrity/single_alternatives.hpp"

namespace dotpose::core {
namespace {

/// Returns the odds of a single alternative at the shift where it shares the line with the rank
/// `shared`. Returns 0 if the alternative also shares a line with a lower rank. The odds are then
/// added at the lower rank.
float odds_of_single(const RankedLines& lines, const RankedLines::Offsets& alternative,
                     int shared) {
    // `base` makes the offset in the shared line 126, which is 0 modulo 63. All offsets remain
    // positive.
    const int base = 2 * kSections - alternative.all[static_cast<std::size_t>(shared)];
    int lost = lines.loss_of_first(alternative.first + kInEach * static_cast<unsigned>(base));
    if (lines.ratios.is_hopeless(lost)) return kNegligible;
    for (int rank = 0; rank < shared; ++rank) {
        if (alternative.all[static_cast<std::size_t>(rank)] + base == 2 * kSections) return 0;
    }
    for (int rank = 8; rank < lines.count(); ++rank) {
        lost += lines.loss(rank, alternative.all[static_cast<std::size_t>(rank)] + base);
        if (lines.ratios.is_hopeless(lost)) return kNegligible;
    }
    return lines.ratios.odds(lost);
}

}  // namespace

float sum_of_single_alternatives(const RankedLines& lines) {
    const LikelihoodRatios& ratios = lines.ratios;
    float sum = 0;
    for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
        for (std::uint32_t alternative = 0; alternative < ratios.basis[k].length; ++alternative) {
            if (alternative == ratios.places[k]) continue;
            for (int shared = 0; shared < lines.count(); ++shared)
                sum += odds_of_single(lines, lines.offsets(k, alternative), shared);
        }
    }
    return sum;
}

}  // namespace dotpose::core

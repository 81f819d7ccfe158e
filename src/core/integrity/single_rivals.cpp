#include "core/integrity/single_rivals.hpp"

namespace dotpose::core {
namespace {

/// Odds of a rival that differs in one sequence and shares a line, and none of a lower rank.
float odds_of_single(const RankedLines& lines, const RankedLines::Grown& rival, int shared) {
    // A growth less that of the shared line; 126 is no shift.
    const int base = 2 * kSections - rival.all[static_cast<std::size_t>(shared)];
    int lost = lines.loss_of_first(rival.first + kInEach * static_cast<unsigned>(base));
    if (lines.contest.is_hopeless(lost)) return kNegligible;
    for (int rank = 0; rank < shared; ++rank) {
        if (rival.all[static_cast<std::size_t>(rank)] + base == 2 * kSections) return 0;
    }
    for (int rank = 8; rank < lines.count(); ++rank) {
        lost += lines.loss(rank, rival.all[static_cast<std::size_t>(rank)] + base);
        if (lines.contest.is_hopeless(lost)) return kNegligible;
    }
    return lines.contest.odds(lost);
}

}  // namespace

float sum_of_single_rivals(const RankedLines& lines) {
    const Contest& contest = lines.contest;
    float sum = 0;
    for (std::size_t k = 0; k < contest.basis.size(); ++k) {
        for (std::uint32_t rival = 0; rival < contest.basis[k].length; ++rival) {
            if (rival == contest.places[k]) continue;
            for (int shared = 0; shared < lines.count(); ++shared)
                sum += odds_of_single(lines, lines.grown(k, rival), shared);
        }
    }
    return sum;
}

}  // namespace dotpose::core

#include "core/decode/double_rivals.hpp"

#include <numeric>

namespace dotpose::core {
namespace {

/// Lines in the order of what they say: the mean odds of a rival that does not share them.
struct Ranking {
    explicit Ranking(const Contest& contest);

    std::array<std::uint8_t, kMaxLines> lines;
    /// How many of them are such that a rival which shares none is hardly possible.
    int anchors = 0;
    /// Expected odds of a rival that shares no anchor.
    float odds_without_anchor = 1;
};

float mean_odds(const Contest& contest, int line) {
    float sum = 0;
    for (int shift = 1; shift < kSections; ++shift)
        sum += contest.odds(contest.loss(line, shift));
    return sum / (kSections - 1);
}

Ranking::Ranking(const Contest& contest) {
    const int count = contest.lines.count();
    std::array<float, kMaxLines> odds;
    for (int line = 0; line < count; ++line) {
        odds[static_cast<std::size_t>(line)] = mean_odds(contest, line);
    }
    const auto end = lines.begin() + count;
    std::iota(lines.begin(), end, std::uint8_t{0});
    std::sort(lines.begin(), end, [&](std::uint8_t a, std::uint8_t b) {
        return odds[a] != odds[b] ? odds[a] < odds[b] : a < b;
    });
    while (anchors < count && odds_without_anchor > kNegligible) {
        odds_without_anchor *= odds[lines[static_cast<std::size_t>(anchors++)]];
    }
    odds_without_anchor = std::max(odds_without_anchor, kNegligible);
}

/// By how much the roll of a sequence's place grows beyond the reading's, up to each line of a
/// ranking.
using Growth = std::array<std::int8_t, kMaxLines>;

void grow(const Contest& contest, const Ranking& ranking, const code::Secondary& a,
          std::uint32_t rival, Growth& growth) {
    std::array<std::int8_t, kMaxLines> by_line;
    std::uint32_t own = contest.position % a.length;
    int grown = 0;
    for (int line = 0; line < contest.lines.count(); ++line) {
        by_line[static_cast<std::size_t>(line)] = static_cast<std::int8_t>(grown);
        grown = (grown + a.weight * (a.digits[rival] - a.digits[own])) % kSections;
        own = own + 1 == a.length ? 0 : own + 1;
        rival = rival + 1 == a.length ? 0 : rival + 1;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(contest.lines.count()); ++i) {
        growth[i] = by_line[ranking.lines[i]];
    }
}

/// Odds of the rival that shares an anchor, and none before it.
float odds_of_anchored(const Contest& contest, const Ranking& ranking, const Growth& a,
                       const Growth& b, int anchor) {
    const auto growth = [&](int i) {
        const auto n = static_cast<std::size_t>(i);
        return a[n] + b[n];
    };
    const int base = growth(anchor);
    int lost = 0;
    for (int i = 0; i < contest.lines.count(); ++i) {
        const int shift = (growth(i) - base) % kSections;
        if (shift == 0) {
            if (i < anchor) return 0;
            continue;
        }
        lost += contest.loss(ranking.lines[static_cast<std::size_t>(i)], shift);
        if (contest.is_hopeless(lost)) return kNegligible;
    }
    return contest.odds(lost);
}

float sum_of_pair(const Contest& contest, const Ranking& ranking, const code::Secondary& first,
                  const code::Secondary& second) {
    float sum = 0;
    Growth a;
    Growth b;
    for (std::uint32_t i = 0; i < first.length; ++i) {
        if (i == contest.position % first.length) continue;
        grow(contest, ranking, first, i, a);
        for (std::uint32_t j = 0; j < second.length; ++j) {
            if (j == contest.position % second.length) continue;
            grow(contest, ranking, second, j, b);
            for (int anchor = 0; anchor < ranking.anchors; ++anchor)
                sum += odds_of_anchored(contest, ranking, a, b, anchor);
            sum += kSections * ranking.odds_without_anchor;
        }
    }
    return sum;
}

}  // namespace

float sum_of_double_rivals(const Contest& contest) {
    const Ranking ranking(contest);
    float sum = 0;
    for (std::size_t k = 0; k < contest.basis.size(); ++k) {
        for (std::size_t l = k + 1; l < contest.basis.size(); ++l)
            sum += sum_of_pair(contest, ranking, contest.basis[k], contest.basis[l]);
    }
    return sum;
}

}  // namespace dotpose::core

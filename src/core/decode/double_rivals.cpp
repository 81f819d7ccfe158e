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
    /// What a rival loses in a line of the ranking, by how much further its roll is plus 126.
    std::array<std::array<std::int16_t, 4 * kSections>, kMaxLines> losses;
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
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        for (int shift = 0; shift < 4 * kSections; ++shift) {
            losses[i][static_cast<std::size_t>(shift)] =
                static_cast<std::int16_t>(contest.loss(lines[i], shift % kSections));
        }
    }
}

/// Growth of all places of a sequence, line by line of a ranking.
class Growths {
  public:
    Growths(const Contest& contest, const Ranking& ranking, std::size_t sequence)
        : own_(contest.places[sequence]), length_(contest.basis[sequence].length) {
        Growth by_line;
        for (std::uint32_t rival = 0; rival < length_; ++rival) {
            grow(contest, sequence, rival, by_line);
            for (std::size_t i = 0; i < static_cast<std::size_t>(contest.lines.count()); ++i)
                growths_[rival][i] = by_line[ranking.lines[i]];
        }
    }

    /// Shows `use` the growth of every place but the reading's own.
    template <typename Use>
    void visit(Use use) const {
        for (std::uint32_t rival = 0; rival < length_; ++rival) {
            if (rival != own_) use(growths_[rival]);
        }
    }

  private:
    static constexpr std::size_t kLongest = 241;
    std::uint32_t own_;
    std::uint32_t length_;
    std::array<Growth, kLongest> growths_;
};

/// Odds of the rival that shares an anchor, and none before it.
float odds_of_anchored(const Contest& contest, const Ranking& ranking, const Growth& a,
                       const Growth& b, int anchor) {
    const auto growth = [&](int i) {
        const auto n = static_cast<std::size_t>(i);
        return a[n] + b[n];
    };
    const int base = growth(anchor) - 2 * kSections;
    int lost = 0;
    for (int i = 0; i < contest.lines.count(); ++i) {
        const int shift = growth(i) - base;
        if (i < anchor && shift % kSections == 0) return 0;
        lost += ranking.losses[static_cast<std::size_t>(i)][static_cast<std::size_t>(shift)];
        if (contest.is_hopeless(lost)) return kNegligible;
    }
    return contest.odds(lost);
}

float sum_of_pair(const Contest& contest, const Ranking& ranking, const Growths& first,
                  const Growths& second) {
    float sum = 0;
    first.visit([&](const Growth& a) {
        second.visit([&](const Growth& b) {
            for (int anchor = 0; anchor < ranking.anchors; ++anchor)
                sum += odds_of_anchored(contest, ranking, a, b, anchor);
            sum += kSections * ranking.odds_without_anchor;
        });
    });
    return sum;
}

}  // namespace

float sum_of_double_rivals(const Contest& contest) {
    const Ranking ranking(contest);
    float sum = 0;
    for (std::size_t k = 0; k < contest.basis.size(); ++k) {
        const Growths first(contest, ranking, k);
        for (std::size_t l = k + 1; l < contest.basis.size(); ++l) {
            sum += sum_of_pair(contest, ranking, first, Growths(contest, ranking, l));
        }
    }
    return sum;
}

}  // namespace dotpose::core

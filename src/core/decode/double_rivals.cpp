#include "core/decode/double_rivals.hpp"

#include <algorithm>
#include <numeric>

namespace dotpose::core {
namespace {

/// Most rivals are hopeless after so many lines: all there are, where there are fewest.
constexpr std::size_t kFirstLines = 6;
/// More than any loss makes up for.
constexpr std::int32_t kNoLoss = INT32_MIN / 8;

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
    /// The same of the first lines; and so little that nothing matters, where it shares the line.
    std::array<std::array<std::int32_t, 4 * kSections>, kFirstLines> first_losses;
    std::array<std::array<std::int32_t, 4 * kSections>, kFirstLines> first_losses_unshared;
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
    for (std::size_t i = 0; i < kFirstLines; ++i) {
        std::copy(losses[i].begin(), losses[i].end(), first_losses[i].begin());
        first_losses_unshared[i] = first_losses[i];
        for (std::size_t shift = 0; shift < 4 * kSections; shift += kSections)
            first_losses_unshared[i][shift] = kNoLoss;
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

/// What rivals with one growth in the first sequence lose in the first lines but the anchor.
class FirstLosses {
  public:
    FirstLosses(const Ranking& ranking, const Growth& a, std::size_t anchor) : anchor_(anchor) {
        std::size_t line = 0;
        for (std::size_t n = 0; n < losses_.size(); ++n, ++line) {
            if (line == anchor) ++line;
            lines_[n] = line;
            const auto& losses =
                line < anchor ? ranking.first_losses_unshared[line] : ranking.first_losses[line];
            losses_[n] = losses.data() + 2 * kSections + a[line] - a[anchor];
        }
    }

    /// As far as no line before the anchor is shared.
    std::int32_t operator()(const Growth& b) const {
        std::int32_t lost = 0;
        for (std::size_t n = 0; n < losses_.size(); ++n)
            lost += losses_[n][b[lines_[n]] - b[anchor_]];
        return lost;
    }

  private:
    std::size_t anchor_;
    std::array<std::size_t, kFirstLines - 1> lines_;
    std::array<const std::int32_t*, kFirstLines - 1> losses_;
};

float sum_of_pair(const Contest& contest, const Ranking& ranking, const Growths& first,
                  const Growths& second) {
    float sum = 0;
    first.visit([&](const Growth& a) {
        std::array<std::optional<FirstLosses>, kMaxLines> first_losses;
        for (int anchor = 0; anchor < ranking.anchors; ++anchor) {
            const auto n = static_cast<std::size_t>(anchor);
            first_losses[n].emplace(ranking, a, n);
        }
        second.visit([&](const Growth& b) {
            for (int anchor = 0; anchor < ranking.anchors; ++anchor) {
                const std::int32_t lost = (*first_losses[static_cast<std::size_t>(anchor)])(b);
                sum += contest.is_hopeless(lost) ? kNegligible
                                                 : odds_of_anchored(contest, ranking, a, b, anchor);
            }
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

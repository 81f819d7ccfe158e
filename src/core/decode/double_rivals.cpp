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
    const int count = contest.count();
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
            for (std::size_t i = 0; i < static_cast<std::size_t>(contest.count()); ++i)
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

    std::size_t count() const { return length_ - 1; }

    static constexpr std::size_t kLongest = 241;

  private:
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
    for (int i = 0; i < contest.count(); ++i) {
        const int shift = growth(i) - base;
        if (i < anchor && shift % kSections == 0) return 0;
        lost += ranking.losses[static_cast<std::size_t>(i)][static_cast<std::size_t>(shift)];
        if (contest.is_hopeless(lost)) return kNegligible;
    }
    return contest.odds(lost);
}

/// The first lines but an anchor.
using FirstLines = std::array<std::size_t, kFirstLines - 1>;

FirstLines first_lines_but(std::size_t anchor) {
    FirstLines lines;
    for (std::size_t n = 0, line = 0; n < lines.size(); ++n, ++line) {
        if (line == anchor) ++line;
        lines[n] = line;
    }
    return lines;
}

/// By how much a sequence grows from an anchor to each of them, plus 63; of all places but the
/// reading's own.
class FirstGrowths {
  public:
    FirstGrowths(const Growths& growths, const FirstLines& lines, std::size_t anchor) {
        growths.visit([&](const Growth& b) {
            auto& grown = growths_[count_];
            for (std::size_t n = 0; n < lines.size(); ++n) {
                grown[n] = static_cast<std::uint8_t>(b[lines[n]] - b[anchor] + kSections);
            }
            places_[count_++] = &b;
        });
    }

    /// Shows `use` those growths of every place and all of its growths.
    template <typename Use>
    void visit(Use use) const {
        for (std::size_t i = 0; i < count_; ++i)
            use(growths_[i], *places_[i]);
    }
    std::size_t count() const { return count_; }

  private:
    std::size_t count_ = 0;
    std::array<std::array<std::uint8_t, kFirstLines - 1>, Growths::kLongest> growths_;
    std::array<const Growth*, Growths::kLongest> places_;
};

float sum_of_anchored(const Contest& contest, const Ranking& ranking, const Growths& first,
                      const Growths& second, std::size_t anchor) {
    const FirstLines lines = first_lines_but(anchor);
    const FirstGrowths growths(second, lines, anchor);
    float sum = 0;
    first.visit([&](const Growth& a) {
        // What is lost in each of the lines, as far as none before the anchor is shared.
        std::array<const std::int32_t*, kFirstLines - 1> losses;
        for (std::size_t n = 0; n < lines.size(); ++n) {
            const std::size_t line = lines[n];
            const auto& all =
                line < anchor ? ranking.first_losses_unshared[line] : ranking.first_losses[line];
            losses[n] = all.data() + kSections + a[line] - a[anchor];
        }
        int hopeless = 0;
        growths.visit([&](const auto& grown, const Growth& b) {
            std::int32_t lost = 0;
            for (std::size_t n = 0; n < lines.size(); ++n)
                lost += losses[n][grown[n]];
            if (contest.is_hopeless(lost)) {
                ++hopeless;
            } else {
                sum += odds_of_anchored(contest, ranking, a, b, static_cast<int>(anchor));
            }
        });
        sum += kNegligible * static_cast<float>(hopeless);
    });
    return sum;
}

float sum_of_pair(const Contest& contest, const Ranking& ranking, const Growths& first,
                  const Growths& second) {
    float sum = static_cast<float>(first.count() * second.count()) * kSections *
                ranking.odds_without_anchor;
    for (std::size_t anchor = 0; anchor < static_cast<std::size_t>(ranking.anchors); ++anchor)
        sum += sum_of_anchored(contest, ranking, first, second, anchor);
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

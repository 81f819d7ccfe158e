#include "core/decode/seam_rivals.hpp"

#include <algorithm>
#include <span>

#include "core/decode/similar_places.hpp"
#include "core/decode/unshared_lines.hpp"

namespace dotpose::core {
namespace {

/// How probable it is beforehand that a certain border between two lines is a seam, and its
/// sections a certain distance apart: so little that a view is still believed which a seam explains
/// as well, but not one that it explains better.
constexpr int kSeam_q8 = -32 * 256;
/// Odds below that, against the position found, are not counted.
constexpr int kLeast_q8 = -8 * 256;

/// What a rival loses at least on one side of a border: in the first n lines from one end of the
/// view, for every n. Nobody shares more lines in a row than `most_shared`.
using OneSide = std::array<int, kMaxLines + 1>;
OneSide least_losses(const Contest& contest, bool from_last) {
    const int count = contest.count();
    OneSide least;
    OneSide with_last;  // of who does not share the last of the n lines
    with_last[0] = 0;
    for (int n = 0;; ++n) {
        const int* last = &with_last[static_cast<std::size_t>(n)];
        least[static_cast<std::size_t>(n)] =
            *std::min_element(last - std::min(n, contest.most_shared()), last + 1);
        if (n == count) return least;
        const int line = from_last ? count - 1 - n : n;
        with_last[static_cast<std::size_t>(n + 1)] =
            least[static_cast<std::size_t>(n)] + std::max(contest.least_loss(line), 0);
    }
}

/// What every rival loses at least, wherever the border is.
int least_loss(const Contest& contest) {
    const int count = contest.count();
    const OneSide before = least_losses(contest, false);
    const OneSide beyond = least_losses(contest, true);
    int least = before[0] + beyond[static_cast<std::size_t>(count)];
    for (int n = 1; n < count; ++n) {
        least = std::min(least, before[static_cast<std::size_t>(n)] +
                                    beyond[static_cast<std::size_t>(count - n)]);
    }
    return least;
}

/// What a rival loses before each line, and from it on, at the best of its shifts; those are left
/// out with which it has lost enough whatever the other one.
class LossesOfSides {
  public:
    LossesOfSides(const Contest& contest, const Growth& growth, int enough) : contest_(contest) {
        before_.fill(kNone);
        from_.fill(kNone);
        const auto grown = std::span(growth).first(static_cast<std::size_t>(contest.count()));
        // What who does not share the lines of a shift loses at least.
        std::array<int, kSections> kept{};
        int in_all = 0;
        int most_kept = 0;
        for (std::size_t line = 0; line < grown.size(); ++line) {
            const int loss = std::max(contest.least_loss(static_cast<int>(line)), 0);
            in_all += loss;
            most_kept = std::max(most_kept, kept[grown[line]] += loss);
        }
        for (const std::uint8_t shift : grown) {
            if (in_all - kept[shift] - most_kept < enough) add(growth, shift);
            kept[shift] = -in_all;  // once is enough
        }
    }

    int with_border_before(int line) const {
        const auto i = static_cast<std::size_t>(line);
        return before_[i] + from_[i];
    }

  private:
    static constexpr int kNone = 1 << 24;

    void add(const Growth& growth, int shift) {
        const int count = contest_.count();
        const auto keep_less = [](int& least, int lost) { least = std::min(least, lost); };
        const auto loss_in = [&](int line) {
            return contest_.loss(line, growth[static_cast<std::size_t>(line)] - shift);
        };
        int lost = 0;
        for (int line = 0; line < count; ++line) {
            keep_less(before_[static_cast<std::size_t>(line)], lost);
            lost += loss_in(line);
        }
        lost = 0;
        for (int line = count; line-- > 0;) {
            lost += loss_in(line);
            keep_less(from_[static_cast<std::size_t>(line)], lost);
        }
    }

    const Contest& contest_;
    std::array<int, kMaxLines> before_;
    std::array<int, kMaxLines> from_;
};

}  // namespace

int seam_rivals_log2_q8(const Contest& contest) {
    const int enough = contest.loss_for(kLeast_q8) + contest.most_regained();
    int sum = kNever_q8;
    if (least_loss(contest) >= enough) return sum;
    const int lines = contest.count();
    const auto add = [&](std::size_t sequence, std::uint32_t place) {
        Growth growth;
        grow(contest, sequence, place, growth);
        const LossesOfSides losses(contest, growth, enough);
        for (int line = 1; line < lines; ++line) {
            const int odds = contest.log2_odds_q8(losses.with_border_before(line));
            if (odds > kLeast_q8) sum = add_log2(sum, odds + kSeam_q8);
        }
    };
    const UnsharedLines unshared(contest);
    visit_similar_places(
        contest, Steps(contest, enough, Excused::any_one),
        [&](std::size_t sequence) {
            return unshared.all_lose(sequence, Sharing::on_two_sides, enough);
        },
        add);
    return sum;
}

}  // namespace dotpose::core

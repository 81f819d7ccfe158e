#include "core/decode/seam_rivals.hpp"

#include <algorithm>
#include <span>

#include "core/decode/least_losses.hpp"
#include "core/decode/similar_places.hpp"

namespace dotpose::core {
namespace {

/// How probable it is beforehand that a certain border between two lines is a seam, and its
/// sections a certain distance apart: so little that a view is still believed which a seam explains
/// as well, but not one that it explains better.
constexpr int kSeam_q8 = -32 * 256;
/// Odds below that, against the position found, are not counted.
constexpr int kLeast_q8 = -8 * 256;

/// What a rival loses before each line, and from it on, at the best of its shifts; those are left
/// out with which it has lost enough whatever the other one.
class LossesOfSides {
  public:
    LossesOfSides(const Contest& contest, const Growth& growth, int enough)
        : contest_(contest), enough_(enough) {
        before_.fill(kNone);
        from_.fill(kNone);
        const auto grown = std::span(growth).first(static_cast<std::size_t>(contest.lines.count()));
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
        const int count = contest_.lines.count();
        const auto keep_less = [](int& least, int lost) { least = std::min(least, lost); };
        const auto loss_in = [&](int line) {
            return contest_.loss(line, growth[static_cast<std::size_t>(line)] - shift);
        };
        // Who has lost enough on one side does not count whatever the other.
        int lost = 0;
        for (int line = 0; line < count && lost < enough_; ++line) {
            keep_less(before_[static_cast<std::size_t>(line)], lost);
            lost += loss_in(line);
        }
        lost = 0;
        for (int line = count; line-- > 0 && lost < enough_;) {
            lost += loss_in(line);
            keep_less(from_[static_cast<std::size_t>(line)], lost);
        }
    }

    const Contest& contest_;
    int enough_;
    std::array<int, kMaxLines> before_;
    std::array<int, kMaxLines> from_;
};

}  // namespace

int seam_rivals_log2_q8(const Contest& contest) {
    const int enough = contest.loss_for(kLeast_q8) + contest.most_regained();
    int sum = kNever_q8;
    if (surely_lose_with_border(contest, enough)) return sum;
    if (least_loss_with_border(contest) >= enough) return sum;
    const int lines = contest.lines.count();
    const auto add = [&](std::size_t sequence, std::uint32_t place) {
        Growth growth;
        grow(contest, sequence, place, growth);
        const LossesOfSides losses(contest, growth, enough);
        for (int line = 1; line < lines; ++line) {
            const int odds = contest.log2_odds_q8(losses.with_border_before(line));
            if (odds > kLeast_q8) sum = add_log2(sum, odds + kSeam_q8);
        }
    };
    visit_similar_places(contest, Steps(contest, enough, Excused::any_one), add);
    return sum;
}

}  // namespace dotpose::core

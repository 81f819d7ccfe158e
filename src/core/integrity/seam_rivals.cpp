#include "core/integrity/seam_rivals.hpp"

#include <algorithm>
#include <span>

#include "core/integrity/least_losses.hpp"
#include "core/integrity/similar_places.hpp"
#include "core/integrity/unshared_lines.hpp"

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

/// Summed odds of those that explain the lines about as well as the position found.
class SeamRivals {
  public:
    SeamRivals(const Contest& contest, int enough) : contest_(contest), enough_(enough) {}

    /// One that differs in a sequence.
    void add(std::size_t sequence, std::uint32_t place) {
        Growth growth;
        grow(contest_, sequence, place, growth);
        const LossesOfSides losses(contest_, growth, enough_);
        for (int line = 1; line < contest_.count(); ++line) {
            const int odds = contest_.log2_odds_q8(losses.with_border_before(line));
            if (odds > kLeast_q8) sum_q8_ = add_log2(sum_q8_, odds + kSeam_q8);
        }
    }
    int sum_q8() const { return sum_q8_; }

  private:
    const Contest& contest_;
    int enough_;
    int sum_q8_ = kNever_q8;
};

/// The loss after which a rival's odds are so small that they are not counted.
int enough_for(const Contest& contest) {
    return contest.loss_for(kLeast_q8) + contest.most_regained();
}

/// Whether nobody can lose less.
bool has_none(const Contest& contest, int enough) {
    return surely_lose_with_border(contest, enough) || least_loss_with_border(contest) >= enough;
}

/// Losses of all steps, in parts so large that a rival which lost `StepLosses::kEnough` of them has
/// lost enough even if one step, that of the border, does not count.
StepLosses losses_of_steps(const Contest& contest, int enough) {
    StepLosses steps;
    steps.count = contest.count() - 1;
    const auto lost_at = [&](int step) {
        return std::min(contest.least_loss_of_step(step), enough);
    };
    int most = 0;
    for (int step = 0; step < steps.count; ++step)
        most = std::max(most, lost_at(step));
    const int part = (enough + most + StepLosses::kEnough - 1) / StepLosses::kEnough;
    for (int step = 0; step < steps.count; ++step)
        steps.parts[static_cast<std::size_t>(step)] =
            static_cast<std::uint8_t>(lost_at(step) / part);
    return steps;
}

}  // namespace

int seam_rivals_log2_q8(const Contest& contest) {
    const int enough = enough_for(contest);
    SeamRivals rivals(contest, enough);
    if (has_none(contest, enough)) return rivals.sum_q8();
    const UnsharedLines unshared(contest);
    visit_similar_places(
        contest, Steps(contest, enough, Excused::any_one),
        [&](std::size_t sequence) {
            return unshared.all_lose(sequence, Sharing::on_two_sides, enough);
        },
        [&](std::size_t sequence, std::uint32_t place) { rivals.add(sequence, place); });
    return rivals.sum_q8();
}

int seam_rivals_log2_q8(const Kernels& kernels, const Contest& contest) {
    const int enough = enough_for(contest);
    SeamRivals rivals(contest, enough);
    if (has_none(contest, enough)) return rivals.sum_q8();
    const StepLosses steps = losses_of_steps(contest, enough);
    for (std::size_t k = 0; k < contest.basis.size(); ++k) {
        const PlaceBits similar =
            kernels.find_similar_places(contest.basis[k], contest.places[k], steps);
        for (std::uint32_t word = 0; word < similar.size(); ++word)
            visit_places(similar[word], word, [&](std::uint32_t place) { rivals.add(k, place); });
    }
    return rivals.sum_q8();
}

}  // namespace dotpose::core

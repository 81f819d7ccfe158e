#include "core/integrity/seam_alternatives.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "core/integrity/least_losses.hpp"
#include "core/integrity/similar_places.hpp"
#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {
namespace {

/// The prior probability that a certain border between two lines is a seam between sections a
/// certain distance apart. It is so small that a position is still believed if a seam explains the
/// view as well, but not if a seam explains it better.
constexpr int kSeam_q8 = -32 * 256;
/// Odds below this, against the position found, are not counted.
constexpr int kLeast_q8 = -8 * 256;

/// The least losses of an alternative before each line, and from it on, over its shifts. Shifts are
/// left out that have lost enough whatever the shift on the other side is.
class LossesOfSides {
  public:
    LossesOfSides(const LikelihoodRatios& ratios, const RollOffsets& offsets, int enough)
        : ratios_(ratios), enough_(enough) {
        before_.fill(kNone);
        from_.fill(kNone);
        const auto in_view = std::span(offsets).first(static_cast<std::size_t>(ratios.count()));
        // The least loss that is kept by sharing the lines of a shift.
        std::array<int, kSections> kept{};
        int in_all = 0;
        int most_kept = 0;
        for (std::size_t line = 0; line < in_view.size(); ++line) {
            const int loss = std::max(ratios.least_loss(static_cast<int>(line)), 0);
            in_all += loss;
            most_kept = std::max(most_kept, kept[in_view[line]] += loss);
        }
        for (const std::uint8_t shift : in_view) {
            if (in_all - kept[shift] - most_kept < enough) add(offsets, shift);
            kept[shift] = -in_all;  // each shift is added once
        }
    }

    int with_border_before(int line) const {
        const auto i = static_cast<std::size_t>(line);
        return before_[i] + from_[i];
    }

  private:
    static constexpr int kNone = 1 << 24;

    void add(const RollOffsets& offsets, int shift) {
        const int count = ratios_.count();
        const auto keep_less = [](int& least, int lost) { least = std::min(least, lost); };
        const auto loss_in = [&](int line) {
            return ratios_.loss(line, offsets[static_cast<std::size_t>(line)] - shift);
        };
        // A shift that has lost enough on one side does not count, whatever the other side.
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

    const LikelihoodRatios& ratios_;
    int enough_;
    std::array<int, kMaxLines> before_;
    std::array<int, kMaxLines> from_;
};

/// Sums up the odds of the seam alternatives that explain the lines about as well as the position
/// found.
class SeamAlternatives {
  public:
    SeamAlternatives(const LikelihoodRatios& ratios, int enough)
        : ratios_(ratios), enough_(enough) {}

    /// Adds an alternative that has another place in one sequence.
    void add(std::size_t sequence, std::uint32_t place) {
        RollOffsets offsets;
        set_roll_offsets(ratios_, sequence, place, offsets);
        const LossesOfSides losses(ratios_, offsets, enough_);
        for (int line = 1; line < ratios_.count(); ++line) {
            const int odds = ratios_.log2_odds_q8(losses.with_border_before(line));
            if (odds > kLeast_q8) sum_q8_ = add_log2(sum_q8_, odds + kSeam_q8);
        }
    }
    int sum_q8() const { return sum_q8_; }

  private:
    const LikelihoodRatios& ratios_;
    int enough_;
    int sum_q8_ = kNever_q8;
};

/// Returns the loss from which on the odds of an alternative are too small to be counted.
int enough_for(const LikelihoodRatios& ratios) {
    return ratios.loss_for(kLeast_q8) + ratios.most_regained();
}

/// Returns the losses of all steps, in parts so large that an alternative which lost
/// `StepLosses::kEnough` of them has lost enough even if one step, that of the border, does not
/// count.
StepLosses losses_of_steps(const LikelihoodRatios& ratios, int enough) {
    StepLosses steps;
    steps.count = ratios.count() - 1;
    const auto lost_at = [&](int step) {
        return std::min(ratios.least_loss_of_step(step), enough);
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

int seam_alternatives_log2_q8(const LikelihoodRatios& ratios) {
    const int enough = enough_for(ratios);
    SeamAlternatives alternatives(ratios, enough);
    if (surely_lose_with_border(ratios, enough) || least_loss_with_border(ratios) >= enough)
        return alternatives.sum_q8();
    const UnsharedLines unshared(ratios);
    visit_similar_places(
        ratios, Steps(ratios, enough, Excused::any_one),
        [&](std::size_t sequence) {
            return unshared.all_lose(sequence, Sharing::on_two_sides, enough);
        },
        [&](std::size_t sequence, std::uint32_t place) { alternatives.add(sequence, place); });
    return alternatives.sum_q8();
}

int seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared) {
    const LikelihoodRatios& ratios = unshared.ratios();
    const int enough = enough_for(ratios);
    SeamAlternatives alternatives(ratios, enough);
    if (surely_lose_with_border(ratios, enough)) return alternatives.sum_q8();
    std::optional<StepLosses> steps;
    for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
        if (unshared.all_lose(k, Sharing::on_two_sides, enough)) continue;
        if (!steps) steps = losses_of_steps(ratios, enough);
        const PlaceBits similar =
            kernels.find_similar_places(ratios.basis[k], ratios.places[k], *steps);
        for (std::uint32_t word = 0; word < similar.size(); ++word)
            visit_places(similar[word], word,
                         [&](std::uint32_t place) { alternatives.add(k, place); });
    }
    return alternatives.sum_q8();
}

}  // namespace dotpose::core

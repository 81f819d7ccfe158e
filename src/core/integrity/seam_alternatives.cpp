#include "core/integrity/seam_alternatives.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "core/integrity/line_sets.hpp"
#include "core/integrity/min_losses.hpp"
#include "core/integrity/similar_places.hpp"
#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {
namespace {

/// Prior probability that a given border between two lines is a seam with a given roll difference,
/// as log2 in units of 2^-8. With this prior and the default limit, a position is accepted if the
/// view is equally likely with and without a seam. It is rejected if the view is at least four
/// times as likely with a seam.
constexpr int kSeam_q8 = -32 * 256;
/// Minimum odds of the alternatives that are included in the sum, as log2 in units of 2^-8. These
/// odds exclude the prior.
constexpr int kMin_q8 = -8 * 256;

/// Estimated costs per place, in units of `WorkLimit`: of a place that is not excluded by its
/// digits, and in addition of `QuickTest` and of `LossesByBorder`.
constexpr std::size_t kWorkPerPlace = 450;
constexpr std::size_t kWorkPerTest = 350;
constexpr std::size_t kWorkPerSum = 1'900;

/// For each border, the minimum loss of an alternative in the lines before the border, and in the
/// lines after it. Each minimum is over all shifts, but shifts where the total loss cannot be below
/// `loss_limit` may be skipped. If all shifts are skipped, the minimum is kNone.
class LossesByBorder {
  public:
    static constexpr int kNone = 1 << 24;

    LossesByBorder(const LikelihoodRatios& ratios, const RollOffsets& offsets, int loss_limit)
        : ratios_(ratios), loss_limit_(loss_limit) {
        const auto in_view = std::span(offsets).first(static_cast<std::size_t>(ratios.count()));
        std::fill_n(before_.begin(), in_view.size(), kNone);
        std::fill_n(from_.begin(), in_view.size(), kNone);
        // For each shift, the loss that the alternative avoids: the sum of the minimum losses of
        // the lines that it shares at this shift.
        std::array<int, kSections> kept{};
        int in_all = 0;
        int max_kept = 0;
        for (std::size_t line = 0; line < in_view.size(); ++line) {
            const int loss = std::max(ratios.min_loss(static_cast<int>(line)), 0);
            in_all += loss;
            max_kept = std::max(max_kept, kept[in_view[line]] += loss);
        }
        for (const std::uint8_t shift : in_view) {
            if (in_all - kept[shift] - max_kept < loss_limit) add(offsets, shift);
            kept[shift] = -in_all;  // marks the shift as added
        }
    }

    /// Returns the minimum loss if the border is directly before `line`.
    int with_border_before(int line) const {
        const auto i = static_cast<std::size_t>(line);
        return before_[i] + from_[i];
    }

  private:
    void add(const RollOffsets& offsets, int shift) {
        const int count = ratios_.count();
        const auto update_min = [](int& min_lost, int lost) {
            min_lost = std::min(min_lost, lost);
        };
        const auto loss_in = [&](int line) {
            return ratios_.loss(line, offsets[static_cast<std::size_t>(line)] - shift);
        };
        // Each loop stops when the loss on its side of the border reaches `loss_limit_`, because
        // the odds at this shift are then negligible for all remaining borders.
        int lost = 0;
        for (int line = 0; line < count && lost < loss_limit_; ++line) {
            update_min(before_[static_cast<std::size_t>(line)], lost);
            lost += loss_in(line);
        }
        lost = 0;
        for (int line = count; line-- > 0 && lost < loss_limit_;) {
            lost += loss_in(line);
            update_min(from_[static_cast<std::size_t>(line)], lost);
        }
    }

    const LikelihoodRatios& ratios_;
    int loss_limit_;
    /// Element n is the minimum total loss in all lines before line n.
    std::array<int, kMaxLines> before_;
    /// Element n is the minimum total loss in line n and all later lines.
    std::array<int, kMaxLines> from_;
};

/// The required lines: those whose minimum loss is at least the loss limit. The odds of a seam
/// alternative are negligible if it does not share one of them. It has one shift before its border
/// and another shift after it, so its roll offset changes at most once from one required line to
/// the next.
class RequiredLines {
  public:
    RequiredLines(const LikelihoodRatios& ratios, int loss_limit) : ratios_(ratios) {
        for (int line = 0; line < ratios.count(); ++line) {
            if (ratios.min_loss(line) >= loss_limit) lines_[count_++] = line;
        }
    }

    std::size_t count() const { return count_; }
    int operator[](std::size_t n) const { return lines_[n]; }

    /// Removes the places whose digits differ from those of the reading at two or more steps
    /// between required lines. Their roll offsets change more than once.
    void keep_similar(std::size_t sequence, PlaceBits& places) const {
        const code::Secondary& a = ratios_.basis[sequence];
        PlaceBits once{};
        PlaceBits twice{};
        for (std::size_t n = 1; n < count_; ++n) {
            const int step = lines_[n - 1];
            if (lines_[n] != step + 1) continue;
            const auto ahead = static_cast<std::uint32_t>(step);
            const std::uint32_t own = (ratios_.places[sequence] + ahead) % a.length;
            const std::uint32_t* equal = a.places_of[a.digit(own)] + ahead / 32;
            for (std::size_t word = 0; word < once.size(); ++word) {
                const std::uint32_t differ =
                    ~(equal[word] >> ahead % 32 | equal[word + 1] << 1 << (31 - ahead % 32));
                twice[word] |= once[word] & differ;
                once[word] |= differ;
            }
        }
        for (std::size_t word = 0; word < places.size(); ++word)
            places[word] &= ~twice[word];
    }

    /// Returns the index of the first required line at which the roll offset changes, or `count()`
    /// if there is no change. Returns 0 if the roll offset changes more than once.
    std::size_t changed_at(const RollOffsets& offsets) const {
        LineSet changes = 0;  // required lines whose roll offset differs from the line before
        for (std::size_t n = 1; n < count_; ++n)
            changes |= LineSet{offset(offsets, n) != offset(offsets, n - 1)} << n;
        if (changes == 0) return count_;
        return std::has_single_bit(changes) ? static_cast<std::size_t>(std::countr_zero(changes))
                                            : 0;
    }

  private:
    std::uint8_t offset(const RollOffsets& offsets, std::size_t n) const {
        return offsets[static_cast<std::size_t>(lines_[n])];
    }

    const LikelihoodRatios& ratios_;
    std::size_t count_ = 0;
    std::array<int, kMaxLines> lines_;
};

/// Tests whether a seam alternative may lose less than a loss limit. Uses only the minimum losses
/// of the lines, and takes a fifth of the time of `LossesByBorder`.
class QuickTest {
  public:
    QuickTest(const LikelihoodRatios& ratios, int loss_limit)
        : loss_limit_(loss_limit), count_(static_cast<std::size_t>(ratios.count())) {
        for (std::size_t line = 0; line < count_; ++line)
            losses_[line] = std::max(ratios.min_loss(static_cast<int>(line)), 0);
    }

    /// Returns true if a seam alternative with the given roll offsets may lose less than the limit
    /// for at least one border. Assumes the best shift on each side of the border, and the minimum
    /// loss for each line that the alternative does not share.
    bool operator()(const RollOffsets& offsets) const {
        // For each line, the minimum loss in all lines before it, at the best shift.
        std::array<int, kMaxLines> before;
        std::array<int, kSections> kept{};  // for each shift, the avoided loss
        int in_all = 0;
        int max_kept = 0;
        const auto add = [&](std::size_t line) {
            in_all += losses_[line];
            max_kept = std::max(max_kept, kept[offsets[line]] += losses_[line]);
        };
        for (std::size_t line = 0; line < count_; ++line) {
            before[line] = in_all - max_kept;
            add(line);
        }
        // A seam alternative shares lines at one or two shifts, so it avoids at most twice the loss
        // that the best single shift avoids.
        if (in_all - 2 * max_kept >= loss_limit_) return false;
        kept.fill(0);
        in_all = max_kept = 0;
        for (std::size_t line = count_; line-- > 1;) {
            add(line);
            if (before[line] + in_all - max_kept < loss_limit_) return true;
        }
        return false;
    }

  private:
    int loss_limit_;
    std::size_t count_;
    std::array<int, kMaxLines> losses_;  ///< minimum losses, or 0 if they are negative
};

/// Sums the odds of the seam alternatives whose odds, without the prior, exceed kMin_q8.
class SeamAlternatives {
  public:
    SeamAlternatives(const LikelihoodRatios& ratios, int loss_limit)
        : ratios_(ratios), loss_limit_(loss_limit) {}

    /// For each border between two lines, adds the odds of the best seam alternative that has the
    /// given roll offsets and its seam at this border. Skips alternatives whose odds without the
    /// prior are at most kMin_q8.
    void add(const RollOffsets& offsets) {
        const LossesByBorder losses(ratios_, offsets, loss_limit_);
        for (int line = 1; line < ratios_.count(); ++line) {
            const int lost = losses.with_border_before(line);
            if (lost < LossesByBorder::kNone) add_loss(lost);
        }
    }
    /// Variant for an alternative that can only have its border after line `last_before` and before
    /// or at line `first_after`, and must share these two lines.
    void add_between(const RollOffsets& offsets, int last_before, int first_after) {
        const auto loss_in = [&](int line, int shared) {
            return ratios_.loss(line, offsets[static_cast<std::size_t>(line)] -
                                          offsets[static_cast<std::size_t>(shared)]);
        };
        int lost = 0;
        // Without an early stop, because its branch would often be mispredicted.
        for (int line = 0; line < last_before; ++line)
            lost += loss_in(line, last_before);
        for (int line = first_after + 1; line < ratios_.count() && lost < loss_limit_; ++line)
            lost += loss_in(line, first_after);
        if (lost >= loss_limit_) return;
        for (int line = last_before + 1; line < first_after; ++line)
            lost += loss_in(line, first_after);
        add_loss(lost);
        for (int line = last_before + 1; line < first_after; ++line) {
            lost += loss_in(line, last_before) - loss_in(line, first_after);
            add_loss(lost);
        }
    }
    int sum_q8() const { return sum_q8_; }

  private:
    void add_loss(int lost) {
        const int odds = ratios_.log2_odds_q8(lost);
        if (odds > kMin_q8) sum_q8_ = add_log2(sum_q8_, odds + kSeam_q8);
    }

    const LikelihoodRatios& ratios_;
    int loss_limit_;
    int sum_q8_ = kNever_q8;
};

/// Returns the loss limit. Alternatives whose minimum losses add up to this limit or more are
/// skipped, because their odds are too small, regardless of their gains in other lines.
int loss_limit_of(const LikelihoodRatios& ratios) {
    return ratios.loss_for(kMin_q8) + ratios.max_gain();
}

/// Returns the step losses in units of `part`, rounded down. A seam alternative avoids the loss in
/// the step that crosses the border. `part` is therefore the smallest integer with
///     kLimitParts * part >= loss_limit + (largest step loss)
/// A sum of kLimitParts units then reaches `loss_limit` even without the largest step loss.
StepLosses losses_of_steps(const LikelihoodRatios& ratios, int loss_limit) {
    StepLosses steps;
    steps.count = ratios.count() - 1;
    const auto lost_at = [&](int step) {
        return std::min(ratios.min_loss_of_step(step), loss_limit);
    };
    int max_lost = 0;
    for (int step = 0; step < steps.count; ++step)
        max_lost = std::max(max_lost, lost_at(step));
    const int part =
        (loss_limit + max_lost + StepLosses::kLimitParts - 1) / StepLosses::kLimitParts;
    for (int step = 0; step < steps.count; ++step) {
        // If both lines of a step have minimum losses of at least the limit, the step loss is set
        // to half of the limit. An alternative that differs in two such steps then reaches the
        // limit, wherever its border is.
        const int lost = lost_at(step);
        steps.parts[static_cast<std::size_t>(step)] = static_cast<std::uint8_t>(
            lost == loss_limit ? StepLosses::kLimitParts / 2 : lost / part);
    }
    return steps;
}

}  // namespace

int seam_alternatives_log2_q8(const LikelihoodRatios& ratios) {
    const int loss_limit = loss_limit_of(ratios);
    SeamAlternatives alternatives(ratios, loss_limit);
    if (must_lose_with_border(ratios, loss_limit) || min_loss_with_border(ratios) >= loss_limit)
        return alternatives.sum_q8();
    const UnsharedLines unshared(ratios);
    visit_similar_places(
        ratios, Steps(ratios, loss_limit, Excused::any_one),
        [&](std::size_t sequence) {
            return unshared.all_lose(sequence, Sharing::on_two_sides, loss_limit);
        },
        [&](std::size_t sequence, std::uint32_t place) {
            RollOffsets offsets;
            set_roll_offsets(ratios, sequence, place, offsets);
            alternatives.add(offsets);
        });
    return alternatives.sum_q8();
}

std::optional<int> seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared,
                                             WorkLimit& work) {
    const LikelihoodRatios& ratios = unshared.ratios();
    const int loss_limit = loss_limit_of(ratios);
    SeamAlternatives alternatives(ratios, loss_limit);
    if (must_lose_with_border(ratios, loss_limit)) return alternatives.sum_q8();
    std::optional<StepLosses> steps;
    std::optional<RequiredLines> required;
    std::optional<QuickTest> may_matter;
    bool is_complete = true;
    const auto add = [&](const RelativeOffsets& set_offsets, std::uint32_t place) {
        if (!work.spend(kWorkPerPlace)) return false;
        RollOffsets offsets;
        set_offsets(place, offsets);
        const std::size_t changed = required->changed_at(offsets);
        if (changed < required->count()) {
            if (changed > 0)
                alternatives.add_between(offsets, (*required)[changed - 1], (*required)[changed]);
            return true;
        }
        if (!work.spend(kWorkPerTest)) return false;
        if (!(*may_matter)(offsets)) return true;
        if (!work.spend(kWorkPerSum)) return false;
        alternatives.add(offsets);
        return true;
    };
    for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
        if (unshared.all_lose(k, Sharing::on_two_sides, loss_limit)) continue;
        if (!steps) steps = losses_of_steps(ratios, loss_limit);
        PlaceBits similar = kernels.find_similar_places(ratios.basis[k], ratios.places[k], *steps);
        if (similar == PlaceBits{}) continue;
        if (!required) {
            required.emplace(ratios, loss_limit);
            may_matter.emplace(ratios, loss_limit);
        }
        required->keep_similar(k, similar);
        const RelativeOffsets set_offsets(ratios, k, 0);
        visit_places(similar, [&](std::uint32_t place) {
            is_complete = is_complete && add(set_offsets, place);
        });
    }
    if (!is_complete) return {};
    return alternatives.sum_q8();
}

int seam_alternatives_log2_q8(const Kernels& kernels, const UnsharedLines& unshared) {
    WorkLimit unlimited(SIZE_MAX);
    return *seam_alternatives_log2_q8(kernels, unshared, unlimited);
}

}  // namespace dotpose::core

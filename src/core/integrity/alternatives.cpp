#include "core/integrity/alternatives.hpp"

#include <algorithm>
#include <optional>

#include "core/integrity/loss_tables.hpp"
#include "core/integrity/planned_alternatives.hpp"
#include "core/integrity/seam_alternatives.hpp"
#include "core/integrity/set_plan.hpp"
#include "core/integrity/single_alternatives.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// Estimated cost per axis, in units of `WorkLimit`, of all steps except the search for far
/// alternatives, without the costs that depend on the number of alternatives or sets.
constexpr std::size_t kPreparation = 47'000;
/// Part of kPreparation for the seam alternatives of an axis. Only a cost above this value is
/// subtracted from the work limit.
constexpr std::size_t kWorkOfSeams = 22'000;

/// Returns the summed odds of the reading's position in all other sections, or an upper bound if it
/// is negligible compared to `max_odds`. In each of these sections, the rolls of all lines differ
/// from the rolls of the reading by the same shift.
float sum_of_other_sections(const LossTables& lines, float max_odds) {
    const float bound = (kSections - 1) * lines.ratios.odds(lines.ratios.min_loss_of_all());
    if (bound < max_odds / 1024) return bound;
    float sum = 0;
    for (int shift = 1; shift < kSections; ++shift) {
        int lost = 0;
        for (int line = 0; line < lines.count(); ++line)
            lost += lines.loss(line, shift);
        sum += lines.ratios.odds(lost);
    }
    return sum;
}

/// Adds up the probabilities of all alternatives on one or two axes, including the seam
/// alternatives.
class Alternatives {
  public:
    Alternatives(const Kernels& kernels, std::span<const UnsharedLines* const> axes, float codes,
                 float max_wrong, WorkLimit& work)
        : kernels_(kernels),
          axes_(axes),
          factor_(kMargin * codes),
          extra_bits_(extra_bits_for(max_wrong / codes)),
          left_(max_wrong),
          work_(work) {}

    /// Adds the probabilities on axis `n` and all later axes. Calls itself for the next axis before
    /// it searches for far alternatives, because that search takes the longest. The faster sums are
    /// therefore complete on all axes before the first search begins. Returns false if the sum
    /// reaches the maximum, or if the computation would exceed the work limit.
    bool add(std::size_t n) {
        if (n == axes_.size()) return add_seams();
        if (!work_.spend(kPreparation)) return false;
        const LossTables lines(axes_[n]->ratios());
        const auto single = sum_of_single_alternatives(kernels_, lines, extra_bits_, work_);
        if (!single) return false;
        if (!spend(factor_ * (*single + sum_of_other_sections(lines, left_ / factor_))))
            return false;
        const SetPlan plan(lines, extra_bits_, work_);
        if (!plan.is_complete()) return false;
        const float fraction = 1 / static_cast<float>(n + 1);
        planned_work_ += work_of_planned_alternatives(plan, fraction * left_ / factor_);
        if (planned_work_ > static_cast<float>(work_.left()) || !add(n + 1)) return false;
        // The last axis is searched first. On each axis, the total expected odds of the sets that
        // are not searched must be at most `fraction` times the remaining probability `left_`. The
        // rest is reserved for the axes that are searched later.
        const auto far =
            sum_of_planned_alternatives(lines, plan, extra_bits_, fraction, left_ / factor_, work_);
        return far && spend(factor_ * *far);
    }
    /// Returns the maximum probability minus the sum so far.
    float left() const { return left_; }

  private:
    static constexpr float kMargin = 1.03F;  ///< covers the rounding errors of the exponentials

    bool add_seams() {
        const std::size_t left = work_.left();
        work_ = WorkLimit(left + axes_.size() * kWorkOfSeams);
        float sum = 0;
        for (const UnsharedLines* axis : axes_) {
            const std::optional<int> odds_q8 = seam_alternatives_log2_q8(kernels_, *axis, work_);
            if (!odds_q8) return false;
            sum += power_of_two_rounded_up(*odds_q8);
        }
        work_ = WorkLimit(std::min(left, work_.left()));
        return planned_work_ <= static_cast<float>(work_.left()) && spend(sum);
    }
    bool spend(float odds) {
        left_ -= odds;
        return left_ > 0;
    }

    const Kernels& kernels_;
    std::span<const UnsharedLines* const> axes_;
    float factor_;
    int extra_bits_;
    float left_;  ///< maximum probability minus the sum so far
    WorkLimit& work_;
    float planned_work_ = 0;  ///< estimated cost of the searches for far alternatives
};

}  // namespace

float wrong_by_alternatives(const Kernels& kernels, std::span<const UnsharedLines* const> axes,
                            float codes, float max_wrong, WorkLimit& work) {
    Alternatives alternatives(kernels, axes, codes, max_wrong, work);
    return alternatives.add(0) ? max_wrong - alternatives.left() : 1;
}

}  // namespace dotpose::core

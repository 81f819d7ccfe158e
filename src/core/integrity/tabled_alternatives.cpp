#include "core/integrity/tabled_alternatives.hpp"

#include <algorithm>
#include <bit>

#include "code/unshared_lines.hpp"

namespace dotpose::core {
namespace {

/// Upper bounds on the odds of the single alternatives that share a line, for each sequence. The
/// bounds are computed from the table that `unshared` uses. The lines that this table covers are
/// called table lines.
class Bounds {
  public:
    explicit Bounds(const UnsharedLines& unshared) : unshared_(unshared) {
        const LikelihoodRatios& ratios = unshared.ratios();
        for (std::size_t n = 1; n < odds_.size(); ++n)
            odds_[n] = ratios.odds(unshared.min_loss_of(n) - ratios.max_gain());
    }
    /// Returns the bound for a sequence. An alternative with n unshared table lines loses at least
    /// the sum of the n smallest minimum losses, minus the maximum gain. `kMaxPositionsWith` bounds
    /// the number of alternatives for each n, and `kUnshared` contains the smallest possible n.
    float operator[](std::size_t sequence) const {
        const LikelihoodRatios& ratios = unshared_.ratios();
        const auto& max_with = code::kMaxPositionsWith[unshared_.tables() - 1][sequence];
        // Adds the alternatives with more than kMaxCounted unshared table lines. An alternative is
        // counted once for each shift at which it shares a line. There are at most `ratios.count()`
        // such shifts.
        float sum =
            static_cast<float>(ratios.count() * ratios.basis[sequence].length) * odds_.back();
        std::size_t n = unshared_.min_unshared(sequence, Sharing::at_one_shift);
        for (n = std::max<std::size_t>(n, 1); n <= max_with.size(); ++n)
            sum += static_cast<float>(max_with[n - 1]) * odds_[n];
        return sum;
    }

  private:
    const UnsharedLines& unshared_;
    /// Element n is an upper bound on the odds of an alternative with n unshared table lines. The
    /// last element also applies to larger n.
    std::array<float, code::kMaxCounted + 2> odds_;
};

}  // namespace

float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float max_odds,
                          unsigned& sequences) {
    if (widest.tables() == 0) return 0;
    const LikelihoodRatios& ratios = widest.ratios();
    float sum = 0;
    const auto add_by = [&](const UnsharedLines& unshared) {
        const Bounds bounds(unshared);
        for (unsigned rest = sequences; rest != 0; rest &= rest - 1) {
            const int sequence = std::countr_zero(rest);
            const float odds = bounds[static_cast<std::size_t>(sequence)];
            if (odds > max_odds) continue;
            sum += odds;
            sequences ^= 1U << sequence;
        }
    };
    add_by(widest);
    for (std::size_t table = widest.tables() - 1; table-- > 0 && sequences != 0;)
        add_by(UnsharedLines(kernels, ratios, code::kUnsharedOf[table]));
    return sum;
}

}  // namespace dotpose::core

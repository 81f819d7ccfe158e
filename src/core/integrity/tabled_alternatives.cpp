#include "core/integrity/tabled_alternatives.hpp"

#include <algorithm>
#include <bit>

#include "code/unshared_lines.hpp"

namespace dotpose::core {
namespace {

/// Bounds of the odds of the alternatives in one sequence that share a line, by one table.
class Bounds {
  public:
    explicit Bounds(const UnsharedLines& unshared) : unshared_(unshared) {
        const LikelihoodRatios& ratios = unshared.ratios();
        for (std::size_t n = 1; n < odds_.size(); ++n)
            odds_[n] = ratios.odds(unshared.least_loss_of(n) - ratios.most_regained());
    }
    /// An alternative that does not share n of the table's lines loses at least what the n cheapest
    /// of them cost. No place has more with that n than the table says, nor any with less than its
    /// own least number.
    float operator[](std::size_t sequence) const {
        const LikelihoodRatios& ratios = unshared_.ratios();
        const auto& most_with = code::kMostWith[unshared_.tables() - 1][sequence];
        // Those that are not counted: they share a line at no more shifts than there are lines.
        float sum =
            static_cast<float>(ratios.count() * ratios.basis[sequence].length) * odds_.back();
        std::size_t n = unshared_.least_unshared(sequence, Sharing::at_one_shift);
        for (n = std::max<std::size_t>(n, 1); n <= most_with.size(); ++n)
            sum += static_cast<float>(most_with[n - 1]) * odds_[n];
        return sum;
    }

  private:
    const UnsharedLines& unshared_;
    /// Element n bounds the odds of an alternative that leaves n lines unshared, the last element
    /// those of all alternatives that leave as many or more.
    std::array<float, code::kMostCounted + 2> odds_;
};

}  // namespace

float tabled_alternatives(const Kernels& kernels, const UnsharedLines& widest, float enough,
                          unsigned& sequences) {
    if (widest.tables() == 0) return 0;
    const LikelihoodRatios& ratios = widest.ratios();
    float sum = 0;
    const auto add_by = [&](const UnsharedLines& unshared) {
        const Bounds bounds(unshared);
        for (unsigned rest = sequences; rest != 0; rest &= rest - 1) {
            const int sequence = std::countr_zero(rest);
            const float odds = bounds[static_cast<std::size_t>(sequence)];
            if (odds > enough) continue;
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

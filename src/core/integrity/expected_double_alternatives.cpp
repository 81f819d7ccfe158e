#include "core/integrity/expected_double_alternatives.hpp"

#include <algorithm>
#include <span>

namespace dotpose::core {
namespace {

/// Safety factor per step, because digits are not random (see expected_alternatives.cpp).
constexpr float kUnevenness = 1.03F;
/// Minimum odds and minimum sums. These minima avoid denormal numbers, which are slow. Sums start
/// at the large value kStart. The minima then contribute little, even if other rolls fit some lines
/// much better than the reading.
constexpr float kMinOdds = 0x1p-40F;
constexpr float kMinSum = 0x1p-80F;
constexpr float kStart = 0x1p40F;

using ByShift = std::array<float, kSections>;

/// Alternatives that differ in two given sequences. Accumulates their expected odds line by line.
class Pair {
  public:
    Pair(const code::Secondary& a, const code::Secondary& b, std::uint32_t position)
        : a_(a), b_(b), place_a_(a.place_of(position)), place_b_(b.place_of(position)) {}

    void add_line(const ByShift& odds, bool is_anchor) {
        if (is_first_) {
            sums_.fill({});
            sums_[0].fill(kStart);
        } else {
            for (ByShift& sums : sums_) {
                step(a_, place_a_, kUnevenness, sums);
                step(b_, place_b_, 1, sums);
            }
            advance(a_, place_a_);
            advance(b_, place_b_);
        }
        is_first_ = false;
        // Sums at shift 0, by number of shared anchors. A shared line has odds of 1.
        std::array<float, kMinFound> shared;
        for (std::size_t n = 0; n < sums_.size(); ++n) {
            shared[n] = sums_[n][0];
            for (std::size_t s = 1; s < kSections; ++s)
                sums_[n][s] = std::max(sums_[n][s], kMinSum) * std::max(odds[s], kMinOdds);
            sums_[n][0] = is_anchor ? (n == 0 ? 0 : shared[n - 1]) : shared[n];
        }
    }

    /// Adds the expected odds of the alternatives with n shared anchors to totals[n].
    void add_to(std::span<float, kMinFound> totals) const {
        const float alternatives = static_cast<float>(a_.length * b_.length) / kStart;
        for (std::size_t n = 0; n < sums_.size(); ++n) {
            for (const float sum : sums_[n])
                totals[n] += alternatives * sum;
        }
    }

  private:
    static void advance(const code::Secondary& of, std::uint32_t& place) {
        if (++place == of.length) place = 0;
    }

    /// Updates the sums for a step in one sequence. The reading's digits are known. An
    /// alternative's digits are assumed to be equally probable.
    static void step(const code::Secondary& of, std::uint32_t place, float factor, ByShift& sums) {
        // Stores the sums twice, to make every cyclic shift contiguous.
        std::array<float, 2 * kSections> before;
        const float fraction = factor / static_cast<float>(of.base);
        for (std::size_t s = 0; s < kSections; ++s)
            before[s] = before[s + kSections] = sums[s] * fraction;
        sums.fill(0);
        for (int digit = 0; digit < of.base; ++digit) {
            const int shift = of.weight * (digit - of.digits[place]);
            const float* from = before.data() + (shift > 0 ? kSections - shift : -shift);
            for (std::size_t s = 0; s < kSections; ++s)
                sums[s] += from[s];
        }
    }

    const code::Secondary& a_;
    const code::Secondary& b_;
    std::uint32_t place_a_;
    std::uint32_t place_b_;
    bool is_first_ = true;
    /// Sums by number of shared anchors and by shift.
    std::array<ByShift, kMinFound> sums_;
};

}  // namespace

std::array<float, kMinFound + 1> expected_double_alternatives(const RankedLines& lines,
                                                              int anchors) {
    const LikelihoodRatios& ratios = lines.ratios;
    std::array<float, kMinFound> totals{};
    for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
        for (std::size_t l = k + 1; l < ratios.basis.size(); ++l) {
            Pair pair(ratios.basis[k], ratios.basis[l], ratios.position);
            for (int line = 0; line < lines.count(); ++line) {
                const bool is_anchor = lines.rank(static_cast<std::uint32_t>(line)) < anchors;
                pair.add_line(lines.odds(line), is_anchor);
            }
            pair.add_to(totals);
        }
    }
    std::array<float, kMinFound + 1> fewer{};
    for (std::size_t n = 0; n < totals.size(); ++n)
        fewer[n + 1] = fewer[n] + totals[n];
    return fewer;
}

}  // namespace dotpose::core

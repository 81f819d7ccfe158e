#include "core/integrity/expected_alternatives.hpp"

#include <bit>
#include <span>

namespace dotpose::core {
namespace {

/// Safety factor per step, because digits are not random. A string of five digits occurs at most
/// once in a sequence. (In `libdots`, six strings occur twice.) In 233 digits of base 3, one
/// occurrence is 3^5 / 233 times the random expectation. Over four sequences, these ratios multiply
/// to 1.12, less than 1.03^5.
constexpr float kUnevenness = 1.03F;

}  // namespace

ExpectedAlternatives::ExpectedAlternatives(const code::Basis& basis, std::uint32_t position,
                                           int max_shared, int min_different)
    : basis_(basis), position_(position), max_shared_(static_cast<std::size_t>(max_shared)) {
    for (unsigned different = 0; different < 16; ++different) {
        if (std::popcount(different) < min_different) continue;
        Set& set = sets_[set_count_++];
        set.different = different;
        set.alternatives = 1;
        set.equal = kUnevenness;
        for (std::size_t k = 0; k < basis.size(); ++k) {
            if ((different >> k & 1) == 0) continue;
            set.alternatives *= static_cast<float>(basis[k].length);
            set.equal /= static_cast<float>(basis[k].base);
        }
    }
}

/// Returns the expected odds after a step, by roll offset. The reading's digits are known. An
/// alternative's digits are assumed to be equally probable.
ExpectedAlternatives::ByShift ExpectedAlternatives::after_step(const Set& set,
                                                               const ByShift& before) const {
    ByShift now = before;
    for (std::size_t k = 0; k < basis_.size(); ++k) {
        if ((set.different >> k & 1) == 0) continue;
        const code::Secondary& a = basis_[k];
        const int own = a.digits[position_ % a.length];
        ByShift next{};
        for (int digit = 0; digit < a.base; ++digit) {
            const auto shift =
                static_cast<std::size_t>((a.weight * (digit - own) + kSections) % kSections);
            for (std::size_t s = 0; s < kSections - shift; ++s)
                next[s + shift] += now[s];
            for (std::size_t s = kSections - shift; s < kSections; ++s)
                next[s + shift - kSections] += now[s];
        }
        now = next;
    }
    for (float& sum : now)
        sum *= set.equal;
    return now;
}

void ExpectedAlternatives::add_line(const ByShift& odds) {
    for (Set& set : std::span(sets_).first(set_count_)) {
        if (is_first_) {
            set.sums = odds;
            set.sums[0] = 0;
            set.shared[0] = odds[0];
            continue;
        }
        ByShift before = set.sums;
        for (const float sum : set.shared)
            before[0] += sum;
        const ByShift after = after_step(set, before);
        // A run of shared lines begins where the roll offset returns to 0. The run continues while
        // all digits equal the reading's digits, because any other digit changes the roll offset.
        float returned = after[0] - before[0] * set.equal;
        returned = returned > 0 ? returned : 0;
        for (std::size_t i = max_shared_ - 1; i > 0; --i) {
            set.shared[i] = set.shared[i - 1] * set.equal * odds[0];
        }
        set.shared[0] = returned * odds[0];
        for (std::size_t s = 1; s < odds.size(); ++s)
            set.sums[s] = after[s] * odds[s];
    }
    if (!is_first_) ++position_;
    is_first_ = false;
}

float ExpectedAlternatives::sum() const {
    float total = 0;
    for (const Set& set : std::span(sets_).first(set_count_)) {
        float sum = 0;
        for (const float s : set.sums)
            sum += s;
        for (const float s : set.shared)
            sum += s;
        total += sum * set.alternatives;
    }
    return total;
}

}  // namespace dotpose::core

#include "core/integrity/similar_places.hpp"

#include <algorithm>

namespace dotpose::core {
namespace {

/// Losses of 32 alternatives, stored as bit-sliced four-bit counters: each word contains one binary
/// digit of every counter.
class Losses {
  public:
    explicit Losses(std::uint32_t excluded) : excluded_(excluded) {}
    /// Adds a loss of 0 to 15 parts to the given alternatives.
    void add(std::uint32_t alternatives, unsigned parts) {
        std::uint32_t carry = 0;
        add_digit(ones_, has_bit(parts, 0), alternatives, carry);
        add_digit(twos_, has_bit(parts, 1), alternatives, carry);
        add_digit(fours_, has_bit(parts, 2), alternatives, carry);
        add_digit(eights_, has_bit(parts, 3), alternatives, carry);
        excluded_ |= carry;
    }
    /// Returns the bit mask of the excluded alternatives. These are the alternatives that were
    /// excluded initially, and the alternatives that lose at least kLimitParts parts.
    std::uint32_t excluded() const { return excluded_; }

  private:
    /// Returns true if the given bit of `n` is set. Shifts this bit to the sign bit, because small
    /// processors test the sign faster than a masked bit.
    static bool has_bit(unsigned n, int bit) {
        return static_cast<std::int32_t>(n << (31 - bit)) < 0;
    }
    static void add_digit(std::uint32_t& digit, bool adds, std::uint32_t alternatives,
                          std::uint32_t& carry) {
        const std::uint32_t before = digit;
        digit ^= carry;
        carry &= before;
        if (!adds) return;
        carry |= digit & alternatives;
        digit ^= alternatives;
    }

    // Counters start at 1, so a loss of 15 parts overflows the highest bit.
    static_assert(kLimitParts == 15);
    std::uint32_t ones_ = ~std::uint32_t{0};
    std::uint32_t twos_ = 0;
    std::uint32_t fours_ = 0;
    std::uint32_t eights_ = 0;
    std::uint32_t excluded_;
};

}  // namespace

Steps::Steps(const LikelihoodRatios& ratios, int loss_limit, Excused excused)
    : count(std::min(ratios.count() - 1, kMaxSteps)), first_line((ratios.count() - 1 - count) / 2) {
    const auto lost_at = [&](int step) {
        return std::min(ratios.min_loss_of_step(first_line + step), loss_limit);
    };
    int needed = loss_limit;
    if (excused == Excused::any_one) {
        // One differing digit is excused and causes no loss. A place is therefore excluded only if
        // its losses add up to at least `loss_limit` even without the largest of them.
        for (int step = 0; step < count; ++step)
            needed = std::max(needed, loss_limit + lost_at(step));
    }
    constexpr int kParts = kLimitParts;
    const int part = (needed + kParts - 1) / kParts;
    // Maximum total loss of nonadjacent steps, in units of `part`. `max_loss` includes all steps so
    // far, and `max_loss_before` excludes the latest step. Adjacent steps are not combined, because
    // the loss of the line that they have in common must not be counted twice.
    int max_loss = 0;
    int max_loss_before = 0;
    for (int step = 0; step < count; ++step) {
        std::uint8_t parts = 0;
        for (int lost = lost_at(step); lost >= part; lost -= part)
            ++parts;
        // Ignores a loss of a single part, because counting it would exclude only a few additional
        // places.
        if (parts == 1) parts = 0;
        losses[static_cast<std::size_t>(step)] = parts;
        const int with_this = max_loss_before + parts;
        max_loss_before = max_loss;
        max_loss = std::max(max_loss, with_this);
    }
    can_exclude = max_loss >= kParts;
}

SimilarPlaces::SimilarPlaces(const code::Secondary& a, std::uint32_t own, const Steps& steps)
    : sequence_(a), own_(own) {
    if (!steps.can_exclude) return;
    for (int step = 0; step < steps.count; ++step) {
        const std::uint8_t parts = steps.losses[static_cast<std::size_t>(step)];
        if (parts > 0) {
            steps_[count_++] = {a.places_of[a.digit(own)], static_cast<std::uint8_t>(step), parts};
        }
        if (++own == a.length) own = 0;
    }
}

// Not inlined, because small processors have too few registers for the combined loops.
[[gnu::noinline]] std::uint32_t SimilarPlaces::operator[](std::uint32_t word) const {
    // Excludes the bits beyond the end of the sequence, and the bit of the reading's own place.
    const std::uint32_t places = sequence_.length - 32 * word;
    std::uint32_t excluded = places < 32 ? ~std::uint32_t{0} << places : 0;
    if (own_ / 32 == word) excluded |= std::uint32_t{1} << own_ % 32;
    Losses losses(excluded);
    std::uint32_t counted = 0;
    int before = -1;
    for (const Step& step : std::span(steps_).first(count_)) {
        const std::uint32_t* here = step.places + word;
        const std::uint32_t equal = here[0] >> step.ahead | here[1] << 1 << (31 - step.ahead);
        // Two adjacent steps have a line in common. The loss of this line must not be counted
        // twice, so a step is counted only if the preceding step is not counted.
        if (step.ahead != before + 1) counted = 0;
        before = step.ahead;
        counted = ~(equal | counted);
        losses.add(counted, step.parts);
        if (losses.excluded() == ~std::uint32_t{0}) return 0;
    }
    return ~losses.excluded();
}

}  // namespace dotpose::core

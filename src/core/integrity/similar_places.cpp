#include "core/integrity/similar_places.hpp"

#include <algorithm>

namespace dotpose::core {
namespace {

/// Losses of 32 alternatives at once, one in each bit.
class Losses {
  public:
    explicit Losses(std::uint32_t enough) : enough_(enough) {}
    /// Adds a loss of 0 to 15 parts to some of the alternatives.
    void add(std::uint32_t alternatives, unsigned parts) {
        std::uint32_t carry = 0;
        add_digit(ones_, has_bit(parts, 0), alternatives, carry);
        add_digit(twos_, has_bit(parts, 1), alternatives, carry);
        add_digit(fours_, has_bit(parts, 2), alternatives, carry);
        add_digit(eights_, has_bit(parts, 3), alternatives, carry);
        enough_ |= carry;
    }
    /// Returns which alternatives have lost enough.
    std::uint32_t enough() const { return enough_; }

  private:
    /// Testing the sign takes fewer instructions.
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

    // Counters start at 1, so that losses that are enough carry.
    static_assert(kEnough == 15);
    std::uint32_t ones_ = ~std::uint32_t{0};
    std::uint32_t twos_ = 0;
    std::uint32_t fours_ = 0;
    std::uint32_t eights_ = 0;
    std::uint32_t enough_;
};

}  // namespace

Steps::Steps(const LikelihoodRatios& ratios, int enough, Excused excused)
    : count(std::min(ratios.count() - 1, kMostSteps)),
      first_line((ratios.count() - 1 - count) / 2) {
    const auto lost_at = [&](int step) {
        return std::min(ratios.least_loss_of_step(first_line + step), enough);
    };
    int needed = enough;
    if (excused == Excused::any_one) {
        // Losses are enough if they are so without any one of the steps.
        for (int step = 0; step < count; ++step)
            needed = std::max(needed, enough + lost_at(step));
    }
    constexpr int kParts = kEnough;
    const int part = (needed + kParts - 1) / kParts;
    // The most that can be lost up to a step, if no two steps in a row count.
    int most = 0;
    int most_before = 0;
    for (int step = 0; step < count; ++step) {
        std::uint8_t parts = 0;
        for (int lost = lost_at(step); lost >= part; lost -= part)
            ++parts;
        // A loss of one part is not worth the work.
        if (parts == 1) parts = 0;
        losses[static_cast<std::size_t>(step)] = parts;
        const int with_this = most_before + parts;
        most_before = most;
        most = std::max(most, with_this);
    }
    tell_apart = most >= kParts;
}

SimilarPlaces::SimilarPlaces(const code::Secondary& a, std::uint32_t own, const Steps& steps)
    : sequence_(a), own_(own) {
    if (!steps.tell_apart) return;
    for (int step = 0; step < steps.count; ++step) {
        const std::uint8_t parts = steps.losses[static_cast<std::size_t>(step)];
        if (parts > 0) {
            steps_[count_++] = {a.places_of[a.digits[own]], static_cast<std::uint8_t>(step), parts};
        }
        if (++own == a.length) own = 0;
    }
}

// Not inlined, so that small processors can keep everything in registers.
[[gnu::noinline]] std::uint32_t SimilarPlaces::operator[](std::uint32_t word) const {
    // Bits beyond the end of the sequence, and that of the reading's own place, count as lost.
    const std::uint32_t places = sequence_.length - 32 * word;
    std::uint32_t unwanted = places < 32 ? ~std::uint32_t{0} << places : 0;
    if (own_ / 32 == word) unwanted |= std::uint32_t{1} << own_ % 32;
    Losses losses(unwanted);
    std::uint32_t counted = 0;
    int before = -1;
    for (const Step& step : std::span(steps_).first(count_)) {
        const std::uint32_t* here = step.places + word;
        const std::uint32_t equal = here[0] >> step.ahead | here[1] << 1 << (31 - step.ahead);
        // No line is counted twice, as a part of two steps.
        if (step.ahead != before + 1) counted = 0;
        before = step.ahead;
        counted = ~(equal | counted);
        losses.add(counted, step.parts);
        if (losses.enough() == ~std::uint32_t{0}) return 0;
    }
    return ~losses.enough();
}

}  // namespace dotpose::core

// Confidence: the reliability of the bits, and the probability that random bits agree with the code
// at least as well as the bits that were read. docs/integrity.md derives the formulas.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dotpose::core {

/// Histogram of bits, by weight in steps of 8 and by agreement with the code.
class Confidence {
  public:
    static constexpr int kLevels = 16;
    /// Returns the weight that represents all bits of a level: the middle of the range of weights.
    static constexpr int weight_of(int level) { return 8 * level + 4; }
    /// Returns the histogram of `bits` hard bits, of which `wrong` are wrong. All hard bits have
    /// the maximum weight.
    static Confidence of_hard_bits(int bits, int wrong) {
        constexpr int kMaxWeight = 127;
        Confidence confidence;
        confidence.add(kMaxWeight, false, bits - wrong);
        confidence.add(kMaxWeight, true, wrong);
        return confidence;
    }

    /// Adds `bits` bits of the same weight, in [-127, 127]. The sign of the weight does not matter.
    void add(int weight, bool is_wrong, int bits = 1) {
        const int level = (weight < 0 ? -weight : weight) >> 3;
        counts_[static_cast<std::size_t>(2 * level + (is_wrong ? 1 : 0))] += bits;
    }
    void add(const Confidence& other) {
        for (std::size_t i = 0; i < counts_.size(); ++i)
            counts_[i] += other.counts_[i];
    }
    /// Returns the number of bits of a level.
    int bits(int level) const {
        return counts_[static_cast<std::size_t>(2 * level)] + wrong(level);
    }
    /// Returns the number of wrong bits of a level.
    int wrong(int level) const { return counts_[static_cast<std::size_t>(2 * level + 1)]; }
    /// Returns the number of bits of all levels.
    int bits() const {
        int sum = 0;
        for (const std::int32_t count : counts_)
            sum += count;
        return sum;
    }
    /// Returns the number of wrong bits of all levels.
    int wrong() const {
        int sum = 0;
        for (int level = 0; level < kLevels; ++level)
            sum += wrong(level);
        return sum;
    }

  private:
    /// For each level, the number of correct bits, followed by the number of wrong bits.
    std::array<std::int32_t, 2 * kLevels> counts_{};
};

/// Returns the odds that a bit of weight 127 is correct, as log2 in units of 2^-8, in [0, 16 *
/// 256]. The log odds of a weaker bit are proportional to its weight. At the returned odds, the
/// expected weight of wrong bits equals the observed weight plus two bits of full weight (logistic
/// regression by maximum likelihood, with a margin of two bits). Returns 0 if the bits carry no
/// information.
int odds_per_bit_q8(const Confidence& confidence);

/// Returns log2 of an upper bound on the probability that random bits of these weights agree with
/// one given place at least as well as the bits that were read, in units of 2^-8 (Chernoff). The
/// result is an upper bound for any value of `odds_per_bit_q8`.
int agreement_log2_q8(const Confidence& bits, int odds_per_bit_q8);

/// Returns log2 of an upper bound on the probability that random bits of these weights agree with
/// the code at least as well as the bits that were read, at any position, in any section, and in
/// any of the four orientations. An axis has L * 63 * 4 hypotheses (position, section and
/// orientation), where L = 410,815,348 is the number of positions. Chernoff's bound, with weights
/// scaled to log odds, applies to each hypothesis. The result is an upper bound for any value of
/// `odds_per_bit_q8`, and is smallest near the true odds.
int chance_log2(const Confidence& axis, int odds_per_bit_q8);

/// Returns the same bound as `chance_log2`, but in units of 2^-8 and for 2^(log2_times_q8 / 256)
/// times the number of hypotheses. Uses the given odds or odds of 2^16, whichever gives the smaller
/// bound.
int chance_log2_q8(const Confidence& axis, int odds_per_bit_q8, int log2_times_q8);

}  // namespace dotpose::core

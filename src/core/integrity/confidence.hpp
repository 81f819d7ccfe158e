// Confidence: the reliability of the bits that were read, and the probability that random bits
// agree with the code at least as well as these bits. See docs/integrity.md, "Chance: a bound".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dotpose::core {

/// Histogram of bits by weight and by agreement with the code. Each level covers eight consecutive
/// magnitudes of the weight.
class Confidence {
  public:
    static constexpr int kLevels = 16;
    /// Returns the weight that represents a level: the middle of its range.
    static constexpr int weight_of(int level) { return 8 * level + 4; }
    /// Returns a histogram with `bits` hard bits, including `wrong` wrong bits. Hard bits have the
    /// maximum weight.
    static Confidence of_hard_bits(int bits, int wrong) {
        constexpr int kMaxWeight = 127;
        Confidence confidence;
        confidence.add(kMaxWeight, false, bits - wrong);
        confidence.add(kMaxWeight, true, wrong);
        return confidence;
    }

    /// Adds `bits` bits of the given weight, which is in [-127, 127]. Ignores the sign of the
    /// weight.
    void add(int weight, bool is_wrong, int bits = 1) {
        const int level = (weight < 0 ? -weight : weight) >> 3;
        counts_[static_cast<std::size_t>(2 * level + (is_wrong ? 1 : 0))] += bits;
    }
    void add(const Confidence& other) {
        for (std::size_t i = 0; i < counts_.size(); ++i)
            counts_[i] += other.counts_[i];
    }
    int bits(int level) const {
        return counts_[static_cast<std::size_t>(2 * level)] + wrong(level);
    }
    int wrong(int level) const { return counts_[static_cast<std::size_t>(2 * level + 1)]; }
    int bits() const {
        int sum = 0;
        for (const std::int32_t count : counts_)
            sum += count;
        return sum;
    }
    int wrong() const {
        int sum = 0;
        for (int level = 0; level < kLevels; ++level)
            sum += wrong(level);
        return sum;
    }

  private:
    /// Element 2 * level is the number of correct bits, and element 2 * level + 1 is the number of
    /// wrong bits.
    std::array<std::int32_t, 2 * kLevels> counts_{};
};

/// Returns the odds that a bit with weight 127 is correct, as log2 in units of 2^-8. The result is
/// in [0, 16 * 256]. Assumes that the log odds of a bit are proportional to its weight. At the
/// returned odds, the expected total weight of the wrong bits equals their observed total weight
/// plus the weight of two hard bits. See docs/integrity.md, "Alternatives: odds". If the error rate
/// is known (see IntegrityOptions::bits_per_error), a smaller weight is added. See
/// docs/integrity.md, "Known error rate". Returns 0 if the bits contain no information.
int odds_per_bit_q8(const Confidence& confidence, int bits_per_error = 0);

/// Returns the Chernoff bound on the probability that random bits with the same weights agree with
/// a given place at least as well as the bits that were read, as log2 in units of 2^-8. Computes
/// the bound for the given odds and for odds of 2^16, and returns the smaller bound. The result is
/// an upper bound on this probability for any value of `odds_per_bit_q8`.
int agreement_log2_q8(const Confidence& bits, int odds_per_bit_q8);

/// Returns log2 of an upper bound on the probability that random bits agree with at least one
/// place, over all sections and orientations, at least as well as the bits that were read. See
/// docs/integrity.md, "Chance: a bound". The result is an upper bound for any value of
/// `odds_per_bit_q8`, and is smallest if this value is near the true odds.
int chance_log2(const Confidence& axis, int odds_per_bit_q8);

/// Variant of `chance_log2` with a result in units of 2^-8. Multiplies the number of hypotheses by
/// 2^(log2_times_q8 / 256). Unlike `chance_log2`, uses the tighter bound of `agreement_log2_q8`.
int chance_log2_q8(const Confidence& axis, int odds_per_bit_q8, int log2_times_q8);

}  // namespace dotpose::core

// Confidence: how sure bits are, and how probable it is that chance agrees as well with the code.
// docs/integrity.md derives both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dotpose::core {

/// How strongly bits were read, and how far the code contradicts them. Weights are kept in steps
/// of 8.
class Confidence {
  public:
    static constexpr int kLevels = 16;
    /// The weight that stands for all of a level.
    static constexpr int weight_of(int level) { return 8 * level + 4; }

    /// weight: -127 to 127.
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
    /// Of all levels.
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
    std::array<std::int32_t, 2 * kLevels> counts_{};  ///< of each level: right, wrong
};

/// The odds, as a power of two in 2^-8, that a bit of weight 127 is right; those of weaker ones
/// grow in proportion to their weight. The value (logistic regression, maximum likelihood) at which
/// as much weight is expected to be wrong as was, and two full bits more; 0 where that says
/// nothing. At most 16 * 256.
int odds_per_bit_q8(const Confidence& confidence);

/// Upper bound, as a power of two, of the probability that random bits of these weights agree as
/// well with some position, section and turn of one axis: L * 63 * 4 hypotheses, each by Chernoff's
/// bound with the weights scaled to log odds. Valid for any odds, and best for the true ones.
int chance_log2(const Confidence& axis, int odds_per_bit_q8);

/// The same in 2^-8, for so many times as many hypotheses, and at the better of these odds and
/// those of bits beyond doubt.
int chance_log2_q8(const Confidence& axis, int odds_per_bit_q8, int log2_times_q8);

}  // namespace dotpose::core

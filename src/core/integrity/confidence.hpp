// Confidence: how sure bits are, and how probable it is that chance agrees with the code as well.
// docs/integrity.md derives both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dotpose::core {

/// Counts bits by their weight, in steps of 8, and by whether the code contradicts them.
class Confidence {
  public:
    static constexpr int kLevels = 16;
    /// Returns the weight that stands for all weights of a level.
    static constexpr int weight_of(int level) { return 8 * level + 4; }

    /// Adds bits of a weight from -127 to 127.
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
    std::array<std::int32_t, 2 * kLevels> counts_{};  ///< by level: right, wrong
};

/// Returns the odds that a bit of weight 127 is right, as log2 in 2^-8, at most 16 * 256; log odds
/// of weaker bits are proportional to their weight. It is the value (logistic regression, maximum
/// likelihood) at which as much weight is expected to be wrong as is, plus two full bits; 0 if that
/// says nothing.
int odds_per_bit_q8(const Confidence& confidence);

/// Returns log2 of an upper bound of the probability that random bits of these weights agree as
/// well with some position, section and turn of one axis: L * 63 * 4 hypotheses, each by Chernoff's
/// bound with weights scaled to log odds. It holds for any odds, and is best for the true ones.
int chance_log2(const Confidence& axis, int odds_per_bit_q8);

/// Returns that bound in 2^-8, for 2^(log2_times_q8 / 256) times as many hypotheses. Of these odds
/// and those of bits beyond doubt the better ones are taken.
int chance_log2_q8(const Confidence& axis, int odds_per_bit_q8, int log2_times_q8);

}  // namespace dotpose::core

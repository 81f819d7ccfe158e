// Expected alternatives: the expected odds of positions that differ from the reading in several
// secondary sequences. There are 4e8 such positions, too many to evaluate one by one. The odds are
// therefore averaged over all places. docs/integrity.md derives the expectation.
#pragma once

#include <array>
#include <cstdint>

#include "code/basis.hpp"

namespace dotpose::core {

/// Accumulates the expected odds line by line.
class ExpectedAlternatives {
  public:
    /// Includes alternatives that differ in at least `min_different` (2 or 3) sequences. They share
    /// at most `max_shared` (3 or 4) adjacent lines with the reading.
    ExpectedAlternatives(const code::Basis& basis, std::uint32_t position, int max_shared,
                         int min_different);

    /// Adds the next line. odds[s] is the odds of an alternative with the roll offset s in this
    /// line. odds[0] is 1.
    void add_line(const std::array<float, kSections>& odds);

    /// Returns the expected odds over the lines added so far.
    float sum() const;

  private:
    /// Number of sets with at least two sequences.
    static constexpr std::size_t kMaxSets = 11;
    static constexpr std::size_t kMaxShared = 4;

    using ByShift = std::array<float, kSections>;
    struct Set {
        unsigned different = 0;  ///< sequences in which the places differ, one bit each
        float alternatives = 0;  ///< number of alternatives
        /// Probability that all digits equal the reading's digits in one step, times the safety
        /// factor kUnevenness.
        float equal = 1;
        /// Expected odds of the alternatives that do not share the newest line, by roll offset in
        /// this line. Element 0 is not used.
        ByShift sums{};
        /// Expected odds of the alternatives that share exactly the newest n + 1 lines, by n.
        std::array<float, kMaxShared> shared{};
    };

    ByShift after_step(const Set& set, const ByShift& before) const;

    const code::Basis& basis_;
    std::uint32_t position_;  ///< position of the newest line
    std::size_t max_shared_;
    std::array<Set, kMaxSets> sets_;
    std::size_t set_count_ = 0;
    bool is_first_ = true;
};

}  // namespace dotpose::core

// Expected alternatives: the odds of all positions that differ from the position read in the places
// of several secondary sequences. There are 4e8 such positions, so the sum is an expectation over
// their places. docs/integrity.md.
#pragma once

#include <array>
#include <cstdint>

#include "code/basis.hpp"

namespace dotpose::core {

/// Adds up the expected odds, line by line.
class ExpectedAlternatives {
  public:
    /// Includes alternatives that share at most `max_shared` adjacent lines with the position read
    /// (3 or 4) and differ in the places of at least `min_different` sequences (2 or 3).
    ExpectedAlternatives(const code::Basis& basis, std::uint32_t position, int max_shared,
                         int min_different);

    /// Adds the next line. `odds` are the odds of an alternative in this line, by its roll offset;
    /// odds[0] is 1.
    void add_line(const std::array<float, kSections>& odds);

    /// Returns the expected odds over the lines added so far.
    float sum() const;

  private:
    /// Number of sets of two or more sequences.
    static constexpr std::size_t kMaxSets = 11;
    static constexpr std::size_t kMaxShared = 4;

    using ByShift = std::array<float, kSections>;
    struct Set {
        unsigned different = 0;  ///< set of sequences, one bit per sequence
        float alternatives = 0;  ///< number of alternatives
        /// Probability that all digits of a step equal the digits of the reading.
        float equal = 1;
        ByShift sums{};  ///< sums indexed by the current shift; element 0 is not used
        std::array<float, kMaxShared>
            shared{};  ///< sums at shift 0, indexed by the number of adjacent shared lines minus 1
    };

    ByShift after_step(const Set& set, const ByShift& before) const;

    const code::Basis& basis_;
    std::uint32_t position_;  ///< position of the last line added
    std::size_t max_shared_;
    std::array<Set, kMaxSets> sets_;
    std::size_t set_count_ = 0;
    bool is_first_ = true;
};

}  // namespace dotpose::core

// Expected alternatives: the odds of all positions that differ from the one found in the places of
// several secondary sequences. There are 4e8 of them, so the sum is an expectation over the places
// that they may have. docs/integrity.md.
#pragma once

#include <array>
#include <cstdint>

#include "code/basis.hpp"

namespace dotpose::core {

/// Sums up the expected odds line by line.
class ExpectedAlternatives {
  public:
    /// Counts alternatives to a position that share at most `most_shared` lines in a row with it, 3
    /// or 4, and differ in the places of at least `fewest_different` sequences, 2 or 3.
    ExpectedAlternatives(const code::Basis& basis, std::uint32_t position, int most_shared,
                         int fewest_different);

    /// Adds the next line, given the odds of an alternative by how much its roll exceeds the
    /// reading's; odds[0] is 1.
    void add_line(const std::array<float, kSections>& odds);

    /// Returns the expected odds over the lines so far.
    float sum() const;

  private:
    /// Number of sets of at least two sequences, whose places may differ.
    static constexpr std::size_t kMostSets = 11;
    static constexpr std::size_t kMostShared = 4;

    using ByShift = std::array<float, kSections>;
    struct Set {
        unsigned different = 0;  ///< a bit for each sequence
        float alternatives = 0;  ///< number of alternatives
        float equal = 1;  ///< probability that all digits of an alternative equal the reading's
        ByShift sums{};   ///< by the current shift; [0] is not used
        std::array<float, kMostShared>
            shared{};  ///< at shift 0, by the number of lines shared in a row
    };

    ByShift after_step(const Set& set, const ByShift& before) const;

    const code::Basis& basis_;
    std::uint32_t position_;  ///< of the line before the next
    std::size_t most_shared_;
    std::array<Set, kMostSets> sets_;
    std::size_t set_count_ = 0;
    bool is_first_ = true;
};

}  // namespace dotpose::core

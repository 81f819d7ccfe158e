// Expected alternatives: the odds of all the positions that differ from the one found in the place
// of several secondary sequences. There are 4e8 of them; what is summed is their expectation over
// the places that they may have. docs/integrity.md.
#pragma once

#include <array>
#include <cstdint>

#include "code/basis.hpp"

namespace dotpose::core {

class ExpectedAlternatives {
  public:
    /// Of a position that share at most so many lines in a row with it, 3 or 4, and differ in the
    /// places of at least so many sequences, 2 or 3.
    ExpectedAlternatives(const code::Basis& basis, std::uint32_t position, int most_shared,
                         int fewest_different);

    /// Adds the next line: the odds of each roll that an alternative may show there, by how much it
    /// exceeds the reading's; odds[0] is 1.
    void add_line(const std::array<float, kSections>& odds);

    /// Over the lines so far.
    float sum() const;

  private:
    /// Sets of sequences whose places differ: at most all of two or more.
    static constexpr std::size_t kMostSets = 11;
    static constexpr std::size_t kMostShared = 4;

    using ByShift = std::array<float, kSections>;
    struct Set {
        unsigned different = 0;  ///< a bit for each sequence
        float alternatives = 0;  ///< how many there are
        float equal = 1;  ///< probability that all digits of an alternative are the reading's
        ByShift sums{};   ///< by the current shift; [0] is not used
        std::array<float, kMostShared>
            shared{};  ///< shift 0, by the number of lines shared in a row
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

// Expected rivals: the odds of all the positions that differ from the one found in the place of two
// or more secondary sequences. There are 4e8 of them; what is summed is their expectation over the
// code, with the exact distribution of digit differences. docs/integrity.md.
#pragma once

#include <array>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

class ExpectedRivals {
  public:
    /// Of those that share at most so many lines in a row with the reading: 3 or 4.
    explicit ExpectedRivals(int most_shared);

    /// Adds the next line: the odds of each roll that a rival may show there, by how much it
    /// exceeds the reading's; odds[0] is 1.
    void add_line(const std::array<float, kSections>& odds);

    /// Over the lines so far.
    float sum() const;

  private:
    /// Sets of sequences whose places differ: all of two or more.
    static constexpr std::size_t kSets = 11;
    static constexpr std::size_t kMostShared = 4;

    using ByShift = std::array<float, kSections>;
    struct Set {
        float rivals = 0;  ///< how many there are
        ByShift steps{};   ///< probability of a difference between two rolls, modulo 63
        ByShift sums{};    ///< by the current shift; [0] is not used
        std::array<float, kMostShared>
            shared{};  ///< shift 0, by the number of lines shared in a row
    };

    std::size_t most_shared_;
    std::array<Set, kSets> sets_;
    bool is_first_ = true;
};

}  // namespace dotpose::core

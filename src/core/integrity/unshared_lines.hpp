// Unshared lines: what every alternative loses that differs from the reading in one sequence, told
// by a table of how many lines it shares at most; most need not be looked at then.
#pragma once

#include <array>
#include <string_view>

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Where an alternative shares lines.
enum class Sharing : std::uint8_t {
    at_one_shift,
    on_two_sides,  ///< up to some border at one shift, beyond it at another
};

class UnsharedLines {
  public:
    static constexpr int kMostLines = 16;

    /// By the table of the most lines that there are, and at most of so many.
    explicit UnsharedLines(const LikelihoodRatios& ratios, int most_lines = kMostLines);

    /// Whether all alternatives that stand elsewhere in a sequence lose so much at least, but for
    /// what they may win back.
    bool all_lose(std::size_t sequence, Sharing sharing, int enough) const {
        return least_loss(sequence, sharing) >= enough;
    }
    /// What they lose at least; 0 where no table tells.
    int least_loss(std::size_t sequence, Sharing sharing) const;
    /// The same of those that stand in another a4, by the rows of `code::kUnsharedInOther`.
    int least_loss(const std::array<std::string_view, 3>& unshared_in_other) const;

  private:
    const LikelihoodRatios& ratios_;
    std::size_t row_ = SIZE_MAX;  ///< of the table; none for few lines
    std::uint32_t first_line_ = 0;
    /// Of the lines that lose least: what so many lose.
    std::array<std::int32_t, kMostLines + 1> least_{};
};

}  // namespace dotpose::core

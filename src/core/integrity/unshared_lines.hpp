// Unshared lines: what every alternative in one sequence loses at least, by a table of how many
// lines it shares at most. Most alternatives need not be looked at then.
#pragma once

#include <array>
#include <string_view>

#include "code/unshared_lines.hpp"
#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Where an alternative shares lines: at one shift, or at two, one before and one beyond a border.
enum class Sharing : std::uint8_t {
    at_one_shift,
    on_two_sides,  ///< up to some border at one shift, beyond it at another
};

/// Least losses of all alternatives in a sequence.
class UnsharedLines {
  public:
    static constexpr int kMostLines = 16;
    /// Uses the table with the most lines, at most `most_lines` and at most as many as there are.
    explicit UnsharedLines(const LikelihoodRatios& ratios, int most_lines = kMostLines);
    /// Uses the same table as the constructor above; a kernel of the desktop sorts the losses.
    UnsharedLines(const Kernels& kernels, const LikelihoodRatios& ratios,
                  int most_lines = kMostLines);

    const LikelihoodRatios& ratios() const { return ratios_; }
    /// Returns the number of tables that suit the number of lines; the one with the most is used.
    std::size_t tables() const { return row_ + 1; }
    /// Returns whether all alternatives in a sequence lose at least `enough`, without what they may
    /// regain.
    bool all_lose(std::size_t sequence, Sharing sharing, int enough) const {
        return least_loss(sequence, sharing) >= enough;
    }
    /// Returns how many of the table's lines all alternatives in a sequence do not share at least;
    /// 0 if there is no table for it.
    std::size_t least_unshared(std::size_t sequence, Sharing sharing) const;
    /// Returns what alternatives lose at least that do not share n of the table's lines, without
    /// what they may regain.
    int least_loss_of(std::size_t n) const { return least_[n]; }
    /// Returns what all alternatives in a sequence lose at least; 0 if there is no table for it.
    int least_loss(std::size_t sequence, Sharing sharing) const;
    /// Returns what all places of another profile's a4 lose at least, by the rows of
    /// `code::kUnsharedInOther`.
    int least_loss(const std::array<std::string_view, 3>& unshared_in_other) const;

  private:
    /// Returns the losses of the lines in the middle, which are longest, that the table is applied
    /// to; none if there are too few lines for one.
    std::span<const std::int16_t> choose_lines(int most_lines);

    const LikelihoodRatios& ratios_;
    std::size_t row_ = SIZE_MAX;  ///< of the table; SIZE_MAX if there are too few lines for one
    std::uint32_t first_line_ = 0;
    LeastSums least_{};  ///< up to the most lines that a table has as not shared
};

inline std::size_t UnsharedLines::least_unshared(std::size_t sequence, Sharing sharing) const {
    const code::Secondary& a = ratios_.basis[sequence];
    // There is no table for the other forms of a4.
    const bool is_known = sequence < 3 || a.digits == code::kA4Restored.data();
    if (row_ == SIZE_MAX || !is_known) return 0;
    const std::uint32_t ahead = ratios_.places[sequence] + first_line_;
    const std::uint32_t place = ahead < a.length ? ahead : ahead - a.length;
    const std::size_t entry = code::kUnsharedFrom[sequence] + place;
    return sharing == Sharing::at_one_shift ? code::unshared_at_one_shift(entry, row_)
                                            : code::unshared_on_two_sides(entry, row_);
}

}  // namespace dotpose::core

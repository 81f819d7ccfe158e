// Unshared lines: the minimum loss of all single alternatives of a sequence, from a table of the
// minimum number of lines that they do not share. Most alternatives then need not be enumerated.
#pragma once

#include <array>
#include <string_view>

#include "code/unshared_lines.hpp"
#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Shifts at which an alternative shares lines.
enum class Sharing : std::uint8_t {
    at_one_shift,
    on_two_sides,  ///< at one shift before any border and at another shift beyond it
};

/// Minimum losses of all single alternatives, by sequence.
class UnsharedLines {
  public:
    static constexpr int kMaxTableLines = 16;
    /// Uses the table with the most lines, at most `max_lines` and at most the number of lines in
    /// view.
    explicit UnsharedLines(const LikelihoodRatios& ratios, int max_lines = kMaxTableLines);
    /// Uses the same table as the constructor above. A kernel sorts the losses.
    UnsharedLines(const Kernels& kernels, const LikelihoodRatios& ratios,
                  int max_lines = kMaxTableLines);

    const LikelihoodRatios& ratios() const { return ratios_; }
    /// Returns the number of tables for at most as many lines as are in view. The last of these
    /// tables is used.
    std::size_t tables() const { return row_ + 1; }
    /// Returns true if all alternatives of a sequence lose at least `loss_limit`, not counting
    /// their gains in other lines.
    bool all_lose(std::size_t sequence, Sharing sharing, int loss_limit) const {
        return min_loss(sequence, sharing) >= loss_limit;
    }
    /// Returns the minimum number of lines of the table that an alternative of a sequence does not
    /// share, or 0 if there is no table for the sequence.
    std::size_t min_unshared(std::size_t sequence, Sharing sharing) const;
    /// Returns the minimum loss of an alternative with n unshared lines of the table, not counting
    /// its gains in other lines.
    int min_loss_of(std::size_t n) const { return smallest_sums_[n]; }
    /// Returns the minimum loss of all alternatives of a sequence, or 0 if there is no table for
    /// the sequence.
    int min_loss(std::size_t sequence, Sharing sharing) const;
    /// Returns the minimum loss of all places in a4 of another code. `unshared_in_other` contains
    /// the rows of `code::kUnsharedInOther` for that code.
    int min_loss(const std::array<std::string_view, 3>& unshared_in_other) const;

  private:
    /// Returns the losses of the lines to which the table is applied. These are in the middle of
    /// the view, where lines are longest. Returns an empty span if there are too few lines for any
    /// table.
    std::span<const std::int16_t> choose_lines(int max_lines);

    const LikelihoodRatios& ratios_;
    /// Row of the table, or SIZE_MAX if there are too few lines for any table.
    std::size_t row_ = SIZE_MAX;
    std::uint32_t first_line_ = 0;
    SmallestSums smallest_sums_{};  ///< sums of the n smallest losses, for each n
};

inline std::size_t UnsharedLines::min_unshared(std::size_t sequence, Sharing sharing) const {
    const code::Secondary& a = ratios_.basis[sequence];
    // Only one variant of a4 has a table.
    const bool is_known = sequence < 3 || a.digits == code::kA4Restored.data();
    if (row_ == SIZE_MAX || !is_known) return 0;
    const std::uint32_t ahead = ratios_.places[sequence] + first_line_;
    const std::uint32_t place = ahead < a.length ? ahead : ahead - a.length;
    const std::size_t entry = code::kUnsharedFrom[sequence] + place;
    return sharing == Sharing::at_one_shift ? code::unshared_at_one_shift(entry, row_)
                                            : code::unshared_on_two_sides(entry, row_);
}

}  // namespace dotpose::core

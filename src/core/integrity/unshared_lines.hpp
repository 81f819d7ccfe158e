// Unshared lines: lower bounds on the losses of the single alternatives of each sequence, from a
// table of the minimum number of lines that the alternatives do not share. With these bounds, most
// alternatives need not be enumerated.
#pragma once

#include <array>
#include <string_view>

#include "code/unshared_lines.hpp"
#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// How an alternative shares lines with the reading: at one shift in all lines, or at two.
enum class Sharing : std::uint8_t {
    at_one_shift,
    on_two_sides,  ///< one shift before a border between two lines, another shift beyond the border
};

/// Lower bounds on the losses of the single alternatives, by sequence. Each table applies to a
/// fixed number of adjacent lines in the middle of the view: 10, 13 or 16. These lines are called
/// the table lines. Losses are summed over the table lines only. A gain in a line that another roll
/// fits better counts as 0.
class UnsharedLines {
  public:
    static constexpr int kMaxTableLines = 16;
    /// Uses the table for the largest number of lines that exceeds neither `max_lines` nor the
    /// number of lines in view.
    explicit UnsharedLines(const LikelihoodRatios& ratios, int max_lines = kMaxTableLines);
    /// Uses the same table as the constructor above, but computes the sums of losses with a kernel.
    UnsharedLines(const Kernels& kernels, const LikelihoodRatios& ratios,
                  int max_lines = kMaxTableLines);

    const LikelihoodRatios& ratios() const { return ratios_; }
    /// Returns the number of tables whose number of lines exceeds neither `max_lines` nor the
    /// number of lines in view. The last of these tables is used.
    std::size_t tables() const { return row_ + 1; }
    /// Returns true if all single alternatives of a sequence lose at least `loss_limit`.
    bool all_lose(std::size_t sequence, Sharing sharing, int loss_limit) const {
        return min_loss(sequence, sharing) >= loss_limit;
    }
    /// Returns the minimum number of table lines that a single alternative of a sequence does not
    /// share, or 0 if there is no table for the sequence.
    std::size_t min_unshared(std::size_t sequence, Sharing sharing) const;
    /// Returns the minimum loss of an alternative with n unshared table lines, for n up to 8.
    int min_loss_of(std::size_t n) const { return smallest_sums_[n]; }
    /// Returns the minimum loss of the single alternatives of a sequence, or 0 if there is no table
    /// for the sequence.
    int min_loss(std::size_t sequence, Sharing sharing) const;
    /// Returns the minimum loss over all places in a4 of another code, or 0 if there are too few
    /// lines for any table. `unshared_in_other` is the element of `code::kUnsharedInOther` for the
    /// code that was read and the other code.
    int min_loss(const std::array<std::string_view, 3>& unshared_in_other) const;

  private:
    /// Chooses the table, and returns the minimum losses of the table lines. The table lines are in
    /// the middle of the view, where the lines have the most bits. Returns an empty span if there
    /// are too few lines for any table.
    std::span<const std::int16_t> choose_lines(int max_lines);

    const LikelihoodRatios& ratios_;
    /// Index of the table in `code::kUnsharedOf`, or SIZE_MAX if there are too few lines for any
    /// table.
    std::size_t row_ = SIZE_MAX;
    /// Index of the first table line in the view.
    std::uint32_t first_line_ = 0;
    SmallestSums smallest_sums_{};  ///< element n: sum of the n smallest losses
};

inline std::size_t UnsharedLines::min_unshared(std::size_t sequence, Sharing sharing) const {
    const code::Secondary& a = ratios_.basis[sequence];
    // The table contains a4 of one code variant only.
    const bool is_known = sequence < 3 || a.digits == code::kA4Restored.data();
    if (row_ == SIZE_MAX || !is_known) return 0;
    const std::uint32_t ahead = ratios_.places[sequence] + first_line_;
    const std::uint32_t place = ahead < a.length ? ahead : ahead - a.length;
    const std::size_t entry = code::kUnsharedFrom[sequence] + place;
    return sharing == Sharing::at_one_shift ? code::unshared_at_one_shift(entry, row_)
                                            : code::unshared_on_two_sides(entry, row_);
}

}  // namespace dotpose::core

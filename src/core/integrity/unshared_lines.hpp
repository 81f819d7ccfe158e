// Unshared lines: lower bounds on the losses of single alternatives. The bounds are computed from
// tables, which contain the minimum number of lines that an alternative does not share. With these
// bounds, few alternatives have to be enumerated. likelihood_ratios.hpp defines the terms.
#pragma once

#include <array>
#include <string_view>

#include "code/unshared_lines.hpp"
#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Shifts at which an alternative shares lines with the reading: the same shift in all lines, or
/// two shifts.
enum class Sharing : std::uint8_t {
    at_one_shift,
    /// One shift before a border between two lines, and another shift after the border.
    on_two_sides,
};

/// Lower bounds on the losses of single alternatives, by sequence. The bounds are derived from
/// precomputed tables. Each table covers 10, 13 or 16 adjacent lines in the middle of the view,
/// called the table lines. Losses in other lines are ignored. Gains are treated as 0.
class UnsharedLines {
  public:
    static constexpr int kMaxTableLines = 16;
    /// Uses the largest table that covers at most `max_lines` lines and fits into the view.
    explicit UnsharedLines(const LikelihoodRatios& ratios, int max_lines = kMaxTableLines);
    /// Variant that sums the losses with a kernel.
    UnsharedLines(const Kernels& kernels, const LikelihoodRatios& ratios,
                  int max_lines = kMaxTableLines);

    const LikelihoodRatios& ratios() const { return ratios_; }
    /// Returns the number of tables that cover at most `max_lines` lines (see the constructor) and
    /// fit into the view. This object uses the largest of these tables.
    std::size_t tables() const { return row_ + 1; }
    /// Returns true if every alternative that differs from the reading only in `sequence` loses at
    /// least `loss_limit`.
    bool all_lose(std::size_t sequence, Sharing sharing, int loss_limit) const {
        return min_loss(sequence, sharing) >= loss_limit;
    }
    /// Returns the minimum number of table lines that a single alternative does not share. Returns
    /// 0 if the sequence has no table.
    std::size_t min_unshared(std::size_t sequence, Sharing sharing) const;
    /// Returns the minimum loss of an alternative with n unshared table lines. `n` must be in
    /// [0, 8].
    int min_loss_of(std::size_t n) const { return smallest_sums_[n]; }
    /// Returns the minimum loss of the single alternatives in a sequence, or 0 if the sequence has
    /// no table.
    int min_loss(std::size_t sequence, Sharing sharing) const;
    /// Returns the minimum loss over all places in the a4 of another code, or 0 if the view has too
    /// few lines. `unshared_in_other` is the element of `code::kUnsharedInOther` for the code that
    /// was read and the other code.
    int min_loss(const std::array<std::string_view, 3>& unshared_in_other) const;

  private:
    /// Chooses the table, and returns the minimum losses of its lines. The table lines are in the
    /// middle of the view, because the lines there have the most bits. Returns an empty span if the
    /// view has too few lines.
    std::span<const std::int16_t> choose_lines(int max_lines);

    const LikelihoodRatios& ratios_;
    /// Index of the table in `code::kUnsharedOf`, or SIZE_MAX if the view has too few lines.
    std::size_t row_ = SIZE_MAX;
    /// Index of the first table line among the lines in view.
    std::uint32_t first_line_ = 0;
    SmallestSums smallest_sums_{};  ///< element n is the sum of the n smallest losses
};

inline std::size_t UnsharedLines::min_unshared(std::size_t sequence, Sharing sharing) const {
    const code::Secondary& a = ratios_.basis[sequence];
    // For a4, `kUnshared` contains only the restored variant, kA4Restored.
    const bool is_known = sequence < 3 || a.rolls == code::kBasis<code::kA4Restored>[3].rolls;
    if (row_ == SIZE_MAX || !is_known) return 0;
    const std::uint32_t ahead = ratios_.places[sequence] + first_line_;
    const std::uint32_t place = ahead < a.length ? ahead : ahead - a.length;
    const std::size_t entry = code::kUnsharedFrom[sequence] + place;
    return sharing == Sharing::at_one_shift ? code::unshared_at_one_shift(entry, row_)
                                            : code::unshared_on_two_sides(entry, row_);
}

}  // namespace dotpose::core

// Set plan: chooses the sets of shared lines whose alternatives are counted one by one. The
// alternatives of all other sets contribute their expected odds. See docs/integrity.md, "Far
// alternatives". likelihood_ratios.hpp defines the terms.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/integrity/line_sets.hpp"
#include "core/integrity/loss_tables.hpp"
#include "core/integrity/work_limit.hpp"

namespace dotpose::core {

/// Set of lines that far alternatives may share.
struct PlannedSet {
    LineSet shared;
    float expected;    ///< expected odds of the far alternatives that share exactly these lines
    float work;        ///< cost of the search for these alternatives, in units of `WorkLimit`
    float priority;    ///< sets with higher priority are searched earlier
    bool is_required;  ///< true if the set must be searched because individual odds may be large
};

/// Returns the estimated cost of the search for the alternatives of one set, in units of
/// `WorkLimit`. `listed` is the number of places in all sequences that the search lists. `tabled`
/// is the number of pairs of places in a1 and a3, `looked_up` the number of pairs in a2 and a4, and
/// `matches` the number of alternatives that these pairs form.
constexpr float work_of_search(float listed, float tabled, float looked_up, float matches) {
    return 1000 + 150 * listed + 16 * tabled + 10 * looked_up + 50 * matches;
}

/// Maximum number of sets in a `SetPlan`.
inline constexpr std::size_t kMaxSets = 1024;

/// The sets of a `SetPlan` that are searched. A set that contains all lines of an earlier set is
/// covered: the search of the earlier set also finds its alternatives.
class SearchedSets {
  public:
    /// Adds a set and returns true. If the set is covered, returns false instead.
    bool add(LineSet set) {
        if (covers(set)) return false;
        sets_[count_++] = set;
        return true;
    }
    bool covers(LineSet set) const {
        const std::span<const LineSet> all = sets();
        return std::any_of(all.begin(), all.end(),
                           [set](LineSet earlier) { return (earlier & ~set) == 0; });
    }
    std::span<const LineSet> sets() const { return std::span(sets_).first(count_); }

  private:
    std::size_t count_ = 0;
    std::array<LineSet, kMaxSets> sets_;
};

/// Lists the sets of lines that far alternatives may share, in the order in which these sets should
/// be searched. The sets contain only lines with a positive minimum loss. The alternatives of a set
/// may also share other lines.
class SetPlan {
  public:
    /// Sets with negligible expected odds are not listed. The threshold is lower if `extra_bits` is
    /// larger (see `extra_bits_for`).
    SetPlan(const LossTables& lines, int extra_bits, WorkLimit& work);
    /// Returns false if there are too many sets, or if listing them would exceed the work limit.
    /// The list is then incomplete.
    bool is_complete() const { return is_complete_; }
    /// Returns the sets. The required sets come first. The other sets are sorted by decreasing
    /// ratio of `expected` to `work`.
    std::span<const PlannedSet> sets() const { return std::span(sets_).first(count_); }
    /// Returns the rest: the summed expected odds of all far alternatives that are not in the first
    /// n sets.
    float rest(std::size_t n) const { return rests_[n]; }
    /// Returns the number of sets that must be searched to reduce the rest to at most `max_rest`.
    /// The result includes all required sets. If the rest cannot be reduced to `max_rest`, returns
    /// the total number of sets.
    std::size_t count_for(float max_rest) const;
    /// Returns the total cost of searching the first n sets, in units of `WorkLimit`. Covered
    /// sets are not searched and cost nothing.
    float work_of(std::size_t n) const;

  private:
    struct Node;
    void set_growth();
    void set_numbers();
    float expected(const Node& node) const;
    float work(const Node& node) const;
    void visit(std::size_t n, Node node);
    bool enter(std::size_t n, const Node& node);
    bool share(int line, Node& node) const;
    void add(const Node& node, float expected);
    void sort_sets();
    void sum_rests();

    static constexpr std::size_t kMaxGaps = (kMaxLines - 1) / 2;

    const LossTables& lines_;
    WorkLimit& work_;
    int required_loss_;
    float negligible_odds_;
    std::size_t compared_count_ = 0;
    std::array<std::uint8_t, kMaxLines> compared_;  ///< lines with a positive minimum loss
    /// For each line in `compared_`, the summed odds of all rolls except the roll of the reading,
    /// divided by kChanges.
    std::array<float, kMaxLines> mean_odds_;
    /// growth_[n] is an upper bound on the sum of the expected odds over all choices of the
    /// compared lines with index `n` or higher, relative to a set without these lines.
    std::array<float, kMaxLines + 1> growth_;
    /// places_[n][k] is the expected number of places in sequence k that have the same digits as
    /// the reading at n given steps.
    std::array<std::array<float, 4>, kMaxLines + 1> places_;
    /// number_[n][m] is the expected number of far alternatives that have the same digits as the
    /// reading in all four sequences at n given steps, and whose roll offset is 0 again after each
    /// of m gaps. Includes correction factors (see kUnevennessOfTwo).
    std::array<std::array<float, kMaxGaps + 1>, kMaxLines + 1> number_;
    std::size_t count_ = 0;
    std::array<PlannedSet, kMaxSets> sets_;
    SearchedSets required_;  ///< the required sets in `sets_`
    bool is_complete_ = true;
    float negligible_ = 0;  ///< summed expected odds of the sets that are not listed
    std::array<float, kMaxSets + 1> rests_;  ///< rests_[n] is the result of rest(n)
};

}  // namespace dotpose::core

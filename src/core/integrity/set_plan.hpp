// Set plan: chooses the sets of shared lines whose alternatives are counted one by one. The
// alternatives of all other sets count with their expected odds. See docs/integrity.md, "Small
// views". likelihood_ratios.hpp defines the terms.
#pragma once

#include <array>
#include <span>

#include "core/integrity/line_sets.hpp"
#include "core/integrity/ranked_lines.hpp"

namespace dotpose::core {

/// Set of lines that far alternatives may share.
struct PlannedSet {
    LineSet shared;
    float expected;    ///< expected odds of the far alternatives that share exactly these lines
    float work;        ///< work of the search for these alternatives, in processor instructions
    bool is_required;  ///< true if the set must be searched, because single odds may be large
};

/// Chooses sets of lines. Lines with a minimum loss of 0 may be shared or not.
class SetPlan {
  public:
    /// The rest is the sum of the expected odds of all sets that are not searched. If the plan is
    /// feasible, the rest is at most `max_rest` / 2 or, if the search would otherwise take more
    /// than `max_work`, at most `max_rest`.
    SetPlan(const RankedLines& lines, float max_rest, float max_work);
    /// Returns false if there are too many sets, if the search would take more than `max_work`, or
    /// if the rest would exceed `max_rest`.
    bool is_feasible() const { return is_complete_ && work_ <= max_work_ && rest_ <= max_rest_; }
    /// Returns the sets to search. The required sets come first. The other sets are sorted by
    /// decreasing ratio of expected odds to work.
    std::span<const PlannedSet> sets() const { return std::span(sets_).first(count_); }
    /// Returns the expected odds of all far alternatives that are not in `sets`.
    float rest() const { return rest_; }

  private:
    struct Node;
    /// A value for the alternatives that differ in two, three and four sequences.
    struct ByDifferent {
        float two;
        float three;
        float four;
    };
    void set_numbers();
    float expected(const Node& node) const;
    float work(const Node& node) const;
    void visit(std::size_t n, const Node& node);
    void visit_shared(std::size_t n, Node node);
    void sort_sets();
    void skip_sets();
    bool contains_another(const PlannedSet& set) const;

    static constexpr std::size_t kMaxSets = 256;

    const RankedLines& lines_;
    float max_rest_;
    float max_work_;
    int required_loss_;
    std::size_t compared_count_ = 0;
    std::array<std::uint8_t, kMaxLines> compared_;  ///< lines with a positive minimum loss
    /// For each compared line, the summed odds of all other rolls, divided by kChanges. Indexed as
    /// `compared_`.
    std::array<float, kMaxLines> mean_odds_;
    /// For n steps between adjacent shared lines, the expected number of places in each sequence
    /// with the digits of the reading in these steps.
    std::array<std::array<float, 4>, kMaxLines + 1> places_;
    /// The expected number of combinations of these places, times a correction factor.
    std::array<ByDifferent, kMaxLines + 1> number_;
    /// Probability that n gaps end at a shared line.
    std::array<ByDifferent, kMaxLines + 1> returned_;
    std::size_t count_ = 0;
    std::array<PlannedSet, kMaxSets> sets_;
    bool is_complete_ = true;
    float rest_ = 0;
    float work_ = 0;
};

}  // namespace dotpose::core

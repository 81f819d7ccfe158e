#include "core/integrity/set_plan.hpp"

#include <algorithm>
#include <bit>

#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// A listed set must be searched if its alternatives may lose less than kRequiredBits bits, without
/// gains in other lines, and the search takes less work than kMaxRequiredWork. A
/// longer search is worthwhile only if the expected odds are large.
constexpr int kRequiredBits = 24;
constexpr float kMaxRequiredWork = 1e6F;

/// A set with expected odds below 2^-kNegligibleBits is not listed. In large views, most of these
/// sets consist of many lines, and alternatives that share all of them are unlikely to exist.
constexpr int kNegligibleBits = 42;

/// Estimated cost of a node of the search tree and of a listed set, in units of `WorkLimit`.
constexpr std::size_t kWorkPerNode = 110;
constexpr std::size_t kWorkPerSet = 400;

/// Number of possible changes of the roll from one line to the next. If an alternative differs in
/// all four sequences, its roll changes are approximately uniformly distributed over these values.
constexpr float kChanges = 54;

/// Correction factors for the expected odds of alternatives that differ in one, two and three
/// sequences. The model assumes that the roll offsets in unshared lines are uniformly distributed.
/// However, if few sequences differ, few changes of the roll are possible. On 700 axes of nominal
/// frames, the expected odds for the actual digits of the reading were on average 10 to 17 times
/// the model's odds if two sequences differ, and 2 times if three differ. If all four differ, they
/// were only 0.6 times the model's odds, so no factor is applied. The factor for one sequence was
/// not measured. It is the square of the factor for two.
constexpr float kUnevennessOfOne = 256;
constexpr float kUnevennessOfTwo = 16;
constexpr float kUnevennessOfThree = 2;
/// Probabilities that the roll offset is 0 again after a gap, that is, after one or more unshared
/// lines. The three values are for alternatives that differ in two, three, and four sequences.
constexpr float kReturnOfTwo = 1.0F / 20;
constexpr float kReturnOfThree = 1.0F / 35;
constexpr float kReturnOfFour = 1 / kChanges;

}  // namespace

/// A node of the search tree over all sets of lines. The node determines which of the first
/// compared lines are shared. The remaining compared lines are undecided.
struct SetPlan::Node {
    LineSet shared = 0;
    /// Product of the mean odds in the unshared lines and in the lines that are not compared.
    float odds = 1;
    int min_loss = 0;    ///< total minimum loss of the unshared lines
    unsigned steps = 0;  ///< number of steps whose two lines are both shared
    unsigned gaps = 0;
    int last = -2;  ///< last shared line
    int run = 0;    ///< length of the run of shared lines that ends with `last`
};

SetPlan::SetPlan(const LossTables& lines, int extra_bits, WorkLimit& work)
    : lines_(lines),
      work_(work),
      required_loss_(lines.ratios.loss_for(-256 * (kRequiredBits + extra_bits))),
      negligible_odds_(power_of_two_exactly(-kNegligibleBits - extra_bits)) {
    Node all;
    for (int line = 0; line < lines.count(); ++line) {
        const float others = lines.odds_of_others(line);
        if (lines.ratios.min_loss(line) > 0) {
            mean_odds_[compared_count_] = others / kChanges;
            compared_[compared_count_++] = static_cast<std::uint8_t>(line);
        } else {
            all.odds *= (others + 1) / kChanges;
        }
    }
    set_growth();
    set_numbers();
    if (enter(0, all)) visit(0, all);
    sort_sets();
    sum_rests();
}

void SetPlan::set_growth() {
    // Probability that an alternative that differs in two sequences has the digits of the reading
    // at a step, at most. For other alternatives, it is smaller.
    constexpr float kMaxEqual = 1.0F / 4;
    growth_[compared_count_] = 1;
    for (std::size_t n = compared_count_; n-- > 0;)
        growth_[n] = growth_[n + 1] * std::max(mean_odds_[n] + kMaxEqual, 1.0F);
}

void SetPlan::set_numbers() {
    std::array<float, 4> places;
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] = static_cast<float>(lines_.ratios.basis[k].length);
    for (std::size_t steps = 0; steps <= compared_count_; ++steps) {
        const auto& [a, b, c, d] = places_[steps] = places;
        float two = kUnevennessOfTwo * (a * b + (a + b) * (c + d) + c * d);
        float three = kUnevennessOfThree * (a * b * (c + d) + (a + b) * c * d);
        float four = a * b * c * d;
        // A set has one line more than steps and gaps together.
        const std::size_t max_gaps = std::min(kMaxGaps, compared_count_ - steps);
        for (std::size_t gaps = 0; gaps <= max_gaps; ++gaps) {
            number_[steps][gaps] = two + three + four;
            two *= kReturnOfTwo;
            three *= kReturnOfThree;
            four *= kReturnOfFour;
        }
        for (std::size_t k = 0; k < places.size(); ++k)
            places[k] *= lines_.ratios.basis[k].base == 2 ? 1.0F / 2 : 1.0F / 3;
    }
    // Includes the single alternatives that share no line. Those that share lines are counted
    // separately.
    const auto& [a, b, c, d] = places_[0];
    number_[0][0] += kUnevennessOfOne * (a + b + c + d);
}

/// Returns the summed expected odds of the far alternatives that share exactly the lines of `node`,
/// if no compared line is undecided. Otherwise, the product with `growth_` is an upper bound on the
/// total for all sets that extend `node`.
float SetPlan::expected(const Node& node) const {
    return (node.shared == 0 ? kSections : 1) * node.odds * number_[node.steps][node.gaps];
}

/// Returns the estimated cost of `SetSearch::add` for the set of `node`, in units of `WorkLimit`.
float SetPlan::work(const Node& node) const {
    constexpr float kNever = 1e9F;
    if (node.shared == 0) return kNever;
    const auto& [a, b, c, d] = places_[node.steps];
    const float tabled = (1 + a) * (1 + c);
    const float looked_up = (1 + b) * (1 + d);
    float matches = tabled * looked_up;
    for (unsigned gap = 0; gap < std::min(node.gaps, 2U); ++gap)
        matches /= kSections;
    return work_of_search(a + b + c + d, tabled, looked_up, matches);
}

/// Adds all sets that extend `node`. Compared lines with index `n` or higher are still undecided.
void SetPlan::visit(std::size_t n, Node node) {
    for (; n < compared_count_; ++n) {
        // Sets with fewer lines are visited first, because they may cover sets with more lines.
        Node without = node;
        without.odds *= mean_odds_[n];
        without.min_loss += lines_.ratios.min_loss(compared_[n]);
        if (enter(n + 1, without)) visit(n + 1, without);
        if (!share(compared_[n], node) || !enter(n + 1, node)) return;
    }
    add(node, expected(node));
}

/// Spends the work of a node. Returns true if the sets that extend `node` must be visited. If their
/// expected odds are negligible, adds them to `negligible_` and returns false. Also returns false
/// if the work limit is reached.
bool SetPlan::enter(std::size_t n, const Node& node) {
    is_complete_ = is_complete_ && work_.spend(kWorkPerNode + 2 * required_.sets().size());
    if (!is_complete_) return false;
    const float expected = this->expected(node);
    if (expected >= negligible_odds_) return true;
    negligible_ += growth_[n] * expected;
    return false;
}

/// Adds `line` to the shared lines of `node`. Returns false if no alternative can share these
/// lines, or if a required set covers them.
bool SetPlan::share(int line, Node& node) const {
    if (node.last == line - 1) {
        // No alternative shares more than `max_shared` adjacent lines.
        if (++node.run > lines_.ratios.max_shared()) return false;
        ++node.steps;
    } else {
        node.run = 1;
        if (node.shared != 0) ++node.gaps;
    }
    node.shared |= LineSet{1} << line;
    node.last = line;
    return !required_.covers(node.shared);
}

void SetPlan::add(const Node& node, float expected) {
    is_complete_ = count_ < kMaxSets && work_.spend(kWorkPerSet);
    if (!is_complete_) return;
    const float work = this->work(node);
    const bool is_required = node.min_loss < required_loss_ && work < kMaxRequiredWork;
    if (is_required) required_.add(node.shared);
    const float priority =
        is_required ? static_cast<float>(kMaxLines - std::popcount(node.shared)) : expected / work;
    sets_[count_++] = {node.shared, expected, work, priority, is_required};
}

/// Sorts the sets. The required sets come first, sorted by increasing number of lines. The other
/// sets follow, sorted by decreasing ratio of `expected` to `work`. Ties are broken by the lines,
/// so that the order is the same with every standard library.
void SetPlan::sort_sets() {
    std::sort(sets_.begin(), sets_.begin() + static_cast<std::ptrdiff_t>(count_),
              [](const PlannedSet& a, const PlannedSet& b) {
                  return a.priority != b.priority ? a.priority > b.priority : a.shared < b.shared;
              });
}

void SetPlan::sum_rests() {
    float rest = negligible_;
    rests_[count_] = rest;
    for (std::size_t n = count_; n-- > 0;)
        rests_[n] = rest += sets_[n].expected;
}

std::size_t SetPlan::count_for(float max_rest) const {
    std::size_t n = 0;
    while (n < count_ && (sets_[n].is_required || rests_[n] > max_rest))
        ++n;
    return n;
}

float SetPlan::work_of(std::size_t n) const {
    float sum = 0;
    SearchedSets searched;
    for (const PlannedSet& set : sets().first(n))
        sum += searched.add(set.shared) ? set.work : 0;
    return sum;
}

}  // namespace dotpose::core

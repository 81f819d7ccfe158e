// Similar places: the places of a sequence whose digits are so similar to the digits of the reading
// that alternatives at these places may matter. The search processes 32 places at a time, one per
// bit.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Maximum number of steps in which digits are compared. A step leads from one line to the next.
inline constexpr int kMaxSteps = 18;

/// Number of parts into which the loss limit is divided.
inline constexpr unsigned kLimitParts = 15;

/// Steps in which an alternative loses nothing, regardless of its digit: none, or any one step. For
/// a seam alternative, this step is the step across the border.
enum class Excused : std::uint8_t { none, any_one };

/// The steps in which digits are compared, and the loss of an alternative in each step where its
/// digit differs from the digit of the reading. Such an alternative shares at most one of the two
/// lines of the step, so it loses at least the smaller of the minimum losses of these lines.
struct Steps {
    Steps(const LikelihoodRatios& ratios, int loss_limit, Excused excused);

    int count;       ///< number of steps, in the middle of the view
    int first_line;  ///< line at which the first step begins
    /// Lower bound on the loss in each step, in units of 1/kLimitParts of the loss that excludes a
    /// place, rounded down. Losses of one unit count as 0.
    std::array<std::uint8_t, kMaxSteps> losses;
    /// True if the losses in nonadjacent steps can add up to the loss that excludes a place.
    bool can_exclude = false;
};

/// The places of a sequence that may lose less than the limit. A place is the index, in the
/// sequence, of the digit in the first step.
class SimilarPlaces {
  public:
    /// `own` is the place of the reading at the first step of `steps`.
    SimilarPlaces(const code::Secondary& a, std::uint32_t own, const Steps& steps);

    /// Returns the similar places among the places 32 * word to 32 * word + 31, one bit per place.
    /// Excludes the place of the reading.
    std::uint32_t operator[](std::uint32_t word) const;

  private:
    struct Step {
        const std::uint32_t* places;  ///< bit set of the places with the digit of the reading
        std::uint8_t ahead;           ///< index of the step
        std::uint8_t parts;           ///< loss in the step, as in `Steps::losses`
    };
    const code::Secondary& sequence_;
    std::uint32_t own_;
    std::size_t count_ = 0;
    std::array<Step, kMaxSteps> steps_;
};

/// Calls `use(place)` for each bit that is set in `places`. `places` is the word with index `word`
/// of a bit set of places.
template <typename Use>
void visit_places(std::uint32_t places, std::uint32_t word, Use use) {
    for (std::uint32_t place = 32 * word; places != 0; ++place, places >>= 1) {
        if ((places & 1) != 0) use(place);
    }
}

/// Calls `use(k, place)` for each similar place of each sequence k. `place` is the place at the
/// first line of the view. Skips the sequences for which `is_settled(k)` returns true.
template <typename IsSettled, typename Use>
void visit_similar_places(const LikelihoodRatios& ratios, const Steps& steps, IsSettled is_settled,
                          Use use) {
    for (std::size_t k = 0; k < ratios.basis.size(); ++k) {
        if (is_settled(k)) continue;
        const code::Secondary& a = ratios.basis[k];
        const auto ahead = static_cast<std::uint32_t>(steps.first_line) % a.length;
        const std::uint32_t own = ratios.places[k] + ahead;
        const SimilarPlaces similar(a, own < a.length ? own : own - a.length, steps);
        const auto use_at_first_line = [&](std::uint32_t place) {
            use(k, place < ahead ? place + a.length - ahead : place - ahead);
        };
        for (std::uint32_t word = 0; 32 * word < a.length; ++word)
            visit_places(similar[word], word, use_at_first_line);
    }
}

}  // namespace dotpose::core

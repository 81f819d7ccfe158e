// Similar places: the places of a sequence whose digits are so similar to the digits of the reading
// that their alternatives may matter. The search processes 32 places at a time, one per bit.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Maximum number of steps between adjacent lines in which digits are compared.
inline constexpr int kMaxSteps = 18;

/// Number of parts into which the loss limit is divided.
inline constexpr unsigned kLimitParts = 15;

/// Steps at which an alternative is excused. The alternative loses nothing in an excused step,
/// regardless of its digit.
enum class Excused : std::uint8_t { none, any_one };

/// Lower bound on the loss of an alternative in each step where its digit differs from the digit of
/// the reading. Such an alternative does not share at least one of the two lines of the step, so it
/// loses at least the smaller of their minimum losses. `losses` is in units of 1/kLimitParts of the
/// loss that excludes a place, rounded down.
struct Steps {
    Steps(const LikelihoodRatios& ratios, int loss_limit, Excused excused);

    int count;
    int first_line;
    std::array<std::uint8_t, kMaxSteps> losses;
    bool can_exclude = false;  ///< true if any place can lose the limit
};

/// The places that may lose less than the limit. A place is identified by its index at the first
/// step.
class SimilarPlaces {
  public:
    /// `own` is the place of the reading at the first step of `steps`.
    SimilarPlaces(const code::Secondary& a, std::uint32_t own, const Steps& steps);

    /// Returns the similar places among places 32 * word to 32 * word + 31, one bit per place.
    /// Excludes the place of the reading.
    std::uint32_t operator[](std::uint32_t word) const;

  private:
    struct Step {
        const std::uint32_t* places;  ///< places at which the digit of the reading occurs
        std::uint8_t ahead;           ///< index of the step
        std::uint8_t parts;           ///< loss of the step, in parts of the limit
    };
    const code::Secondary& sequence_;
    std::uint32_t own_;
    std::size_t count_ = 0;
    std::array<Step, kMaxSteps> steps_;
};

/// Calls `use` for each place whose bit is set in a word. `word` is the index of the word.
template <typename Use>
void visit_places(std::uint32_t places, std::uint32_t word, Use use) {
    for (std::uint32_t place = 32 * word; places != 0; ++place, places >>= 1) {
        if ((places & 1) != 0) use(place);
    }
}

/// Calls `use` with the sequence and the place of each similar place, at the first line. Skips
/// sequences for which `is_settled` returns true.
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

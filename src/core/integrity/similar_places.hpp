// Similar places: the places of a sequence whose digits are so similar to those of the reading that
// their alternatives may matter. The search processes 32 places at a time, one per bit.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Maximum number of steps between adjacent lines in which digits are compared.
inline constexpr int kMaxSteps = 18;

/// Number of parts into which the loss limit is divided.
inline constexpr unsigned kLimitParts = 15;

/// Steps at which an alternative is excused: it loses nothing there, regardless of its digit.
enum class Excused : std::uint8_t { none, any_one };

/// Minimum loss of an alternative in each step in which its digit differs from that of the reading.
/// Such an alternative does not share one of the two lines, so its loss is at least the smaller
/// loss of the two lines. In parts of the loss limit, rounded down.
struct Steps {
    Steps(const LikelihoodRatios& ratios, int loss_limit, Excused excused);

    int count;
    int first_line;
    std::array<std::uint8_t, kMaxSteps> losses;
    bool can_exclude = false;  ///< true if any place can lose the limit
};

/// The places, at the first step, that may lose less than the limit.
class SimilarPlaces {
  public:
    /// `own` is the place of the reading at the first step of `steps`.
    SimilarPlaces(const code::Secondary& a, std::uint32_t own, const Steps& steps);

    /// Returns the similar places among the 32 places from 32 * word on, except the place of the
    /// reading.
    std::uint32_t operator[](std::uint32_t word) const;

  private:
    struct Step {
        const std::uint32_t* places;  ///< places at which the digit of the reading occurs
        std::uint8_t ahead;           ///< number of the step
        std::uint8_t parts;           ///< loss, in parts of the limit
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

/// Calls `use` with the sequence and the place, at the first line, of all similar places. Skips
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

// Similar places: the alternatives in one sequence whose digits are so similar to the reading's
// that they cannot be passed over; 32 at a time, one in each bit.
#pragma once

#include "core/integrity/likelihood_ratios.hpp"

namespace dotpose::core {

/// Most steps between adjacent lines in which digits are compared.
inline constexpr int kMostSteps = 18;

/// Parts that are enough to lose.
inline constexpr unsigned kEnough = 15;

/// Steps at which an alternative is excused: it loses nothing there, whatever its digit.
enum class Excused : std::uint8_t { none, any_one };

/// What an alternative loses at least in the steps where its digit differs from the reading's: one
/// of the two lines is not shared, so the smaller loss of the two. In parts of what is enough,
/// rounded down.
struct Steps {
    Steps(const LikelihoodRatios& ratios, int enough, Excused excused);

    int count;
    int first_line;
    std::array<std::uint8_t, kMostSteps> losses;
    bool tell_apart = false;  ///< whether any place can lose enough
};

/// The places at the first step that, as far as the steps tell, do not lose enough.
class SimilarPlaces {
  public:
    /// `own` is the reading's place at the first step of `steps`.
    SimilarPlaces(const code::Secondary& a, std::uint32_t own, const Steps& steps);

    /// Returns the similar ones of the 32 places from 32 * word on, except the reading's own.
    std::uint32_t operator[](std::uint32_t word) const;

  private:
    struct Step {
        const std::uint32_t* places;  ///< where the reading's digit occurs
        std::uint8_t ahead;           ///< number of the step
        std::uint8_t parts;           ///< the loss, in parts of what is enough
    };
    const code::Secondary& sequence_;
    std::uint32_t own_;
    std::size_t count_ = 0;
    std::array<Step, kMostSteps> steps_;
};

/// Calls `use` for the places that are set in the word at 32 * `word`.
template <typename Use>
void visit_places(std::uint32_t places, std::uint32_t word, Use use) {
    for (std::uint32_t place = 32 * word; places != 0; ++place, places >>= 1) {
        if ((places & 1) != 0) use(place);
    }
}

/// Calls `use` with the sequence and the place at the first line of all similar places. Sequences
/// that `is_settled` returns true for are left out.
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

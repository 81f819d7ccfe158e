// Similar places: the places in a sequence whose digits are similar to the digits of the reading.
// All other places lose too much to be relevant. The search tests 32 places at a time, one per bit
// of a word. likelihood_ratios.hpp defines the terms.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <tuple>

#include "core/integrity/likelihood_ratios.hpp"
#include "core/kernels/kernels.hpp"

namespace dotpose::core {

/// Maximum number of steps at which digits are compared. A step leads from one line to the next.
inline constexpr int kMaxSteps = 18;

/// Number of parts into which the loss that excludes a place is divided. Losses are stored as
/// numbers of parts. The loss that excludes a place is the loss limit or, for `Excused::any_one`,
/// the loss limit plus the largest loss at one step.
inline constexpr unsigned kLimitParts = 15;

/// Steps at which the digit of an alternative may differ from the digit of the reading without a
/// loss: none, or any one step. `any_one` is for seam alternatives, which have no loss at the step
/// across the border.
enum class Excused : std::uint8_t { none, any_one };

/// The steps at which digits are compared and, for each step, the loss of an alternative whose
/// digit differs from the digit of the reading. Such an alternative shares at most one of the two
/// lines of the step, so its loss is at least the smaller of the minimum losses of the two lines.
struct Steps {
    Steps(const LikelihoodRatios& ratios, int loss_limit, Excused excused);

    int count;       ///< number of compared steps, in the middle of the view
    int first_line;  ///< first line of the first step
    /// Lower bound on the loss at each step, in parts (see `kLimitParts`), rounded down. Losses of
    /// one part are replaced with 0, because they would exclude only a few additional places.
    std::array<std::uint8_t, kMaxSteps> losses;
    /// True if the total loss at nonadjacent steps can be large enough to exclude a place.
    bool can_exclude = false;
};

/// The places in a sequence whose loss may be too small to exclude them. In this class, the place
/// of an alternative is the index of its digit at the first step of `Steps`.
class SimilarPlaces {
  public:
    /// `own` is the place of the reading at the first step.
    SimilarPlaces(const code::Secondary& a, std::uint32_t own, const Steps& steps);

    /// Returns the similar places among 32 * word to 32 * word + 31, one bit per place. Excludes
    /// the place of the reading.
    std::uint32_t operator[](std::uint32_t word) const;

  private:
    struct Step {
        const std::uint32_t* places;  ///< places with the reading's digit, as a bit set
        std::uint8_t ahead;           ///< index of the step
        std::uint8_t parts;           ///< loss at the step, as in `Steps::losses`
    };
    const code::Secondary& sequence_;
    std::uint32_t own_;
    std::size_t count_ = 0;
    std::array<Step, kMaxSteps> steps_;
};

/// Calls `use(place)` for each set bit of `places`, in ascending order.
template <typename Use>
void visit_places(const PlaceBits& places, Use use) {
    // Uses one loop over the bits of all words. Processors cannot predict the end of a loop over
    // the bits of a single word.
    struct Word {
        std::uint32_t bits;
        std::uint32_t first;
    };
    std::array<Word, std::tuple_size_v<PlaceBits> + 1> words;
    std::size_t count = 0;
    for (std::uint32_t word = 0; word < places.size(); ++word) {
        words[count] = {places[word], 32 * word};
        count += places[word] != 0 ? 1 : 0;
    }
    words[count] = {0, 0};
    const Word* word = words.data();
    std::uint32_t bits = word->bits;
    while (bits != 0) {
        use(word->first + static_cast<std::uint32_t>(std::countr_zero(bits)));
        bits &= bits - 1;
        // Without a branch, continues with the next word after the last bit of this word.
        const std::uint32_t is_last = bits == 0 ? 1 : 0;
        word += is_last;
        bits |= word->bits & (0 - is_last);
    }
}

/// Calls `use(k, place)` for each similar place in each sequence k, where `place` is the place at
/// the first line in view. Skips sequences for which `is_settled(k)` returns true.
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
        PlaceBits places{};
        for (std::uint32_t word = 0; 32 * word < a.length; ++word)
            places[word] = similar[word];
        visit_places(places, use_at_first_line);
    }
}

}  // namespace dotpose::core

// Lines that agree with the reading and, almost as well, with one alternative, for tests of sums
// over alternatives. All other positions have much smaller odds.
#pragma once

#include <string_view>

#include "ratios_case.hpp"

namespace dotpose::core_test {

/// Returns the place in a sequence, other than `own`, that has the most digits in common with `own`
/// at steps 3 to 6. Ties are broken at random.
inline std::uint32_t similar_place(const std::string_view text, std::uint32_t own, Rng& rng) {
    const auto length = static_cast<std::uint32_t>(text.size());
    const std::uint32_t first = rng.below(length);
    std::uint32_t most_similar = own;
    int most = -1;
    for (std::uint32_t n = 0; n < length; ++n) {
        const std::uint32_t place = (first + n) % length;
        if (place == own) continue;
        int equal = 0;
        for (std::uint32_t step = 3; step < 7; ++step)
            equal += text[(place + step) % length] == text[(own + step) % length] ? 1 : 0;
        if (equal > most) {
            most = equal;
            most_similar = place;
        }
    }
    return most_similar;
}

/// Lines that score 1000 at the roll of the reading, 900 at the roll of an alternative, and -2100
/// to -1500 at all other rolls. The alternative differs from the reading in the sequences whose
/// bits in `different` are set.
struct SimilarCase {
    static constexpr int kLines = 11;

    SimilarCase(Rng& rng, unsigned different) : lines(at_random_place(rng, kLines)) {
        lines.odds_q8 = 3 * 256;
        const auto texts = code_test::secondary_texts(lines.code);
        PlacesOfAlternative places = own_places(lines);
        for (std::size_t k = 0; k < places.size(); ++k) {
            if ((different >> k & 1) != 0) places[k] = similar_place(texts[k], places[k], rng);
        }
        constexpr std::size_t kShared = 3;
        rolls = rolls_from(lines, places, kShared);
        for (std::size_t line = 0; line < kLines; ++line) {
            ScoredLine scored;
            for (std::int16_t& score : scored.scores)
                score = static_cast<std::int16_t>(-1500 - static_cast<int>(rng.below(600)));
            scored.scores[static_cast<std::size_t>(rolls[line])] = 900;
            scored.scores[static_cast<std::size_t>(lines.rolls[line])] = 1000;
            scored.best = best_score(scored.scores);
            lines.storage.push_back(scored);
        }
    }
    RatiosCase lines;
    std::vector<int> rolls;
};

}  // namespace dotpose::core_test

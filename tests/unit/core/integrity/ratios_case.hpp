// Random lines of bits, for tests of sums over alternatives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "../../code/reference.hpp"
#include "core/decode/correlation.hpp"
#include "core/integrity/likelihood_ratios.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test {

using namespace core;

/// Consecutive lines of the code, starting at a position, and the odds of their bits.
struct RatiosCase {
    CodeVariant code;
    std::uint32_t position;
    std::vector<int> rolls;
    std::vector<ScoredLine> storage;
    int odds_q8;

    Lines lines() const { return {storage}; }
    AxisReading reading() const { return {position, static_cast<std::uint8_t>(rolls[0]), 0, 0}; }
    LikelihoodRatios ratios() const { return {code, lines(), reading(), odds_q8}; }
};

/// Returns a line of `bits` bits of the main sequence, with random weights from `most` / 2 to
/// `most`. Each bit is flipped with probability `wrong`.
inline ScoredLine scored_line(int roll, int bits, double wrong, int most, Rng& rng) {
    std::vector<std::int8_t> weights;
    for (int i = 0; i < bits; ++i) {
        const int weight = most - static_cast<int>(rng.below(static_cast<std::uint32_t>(most) / 2));
        const bool is_one =
            (code_test::digit_at(code_test::kMainText, static_cast<std::uint64_t>(roll + i)) ==
             1) != (rng.uniform() < wrong);
        weights.push_back(static_cast<std::int8_t>(is_one ? weight : -weight));
    }
    ScoredLine line;
    correlate(weights, line.scores);
    line.best = best_score(line.scores);
    return line;
}

/// Returns a case at a random place, with the rolls of `lines` lines. The caller adds the scores of
/// the lines to `storage`.
inline RatiosCase at_random_place(Rng& rng, int lines) {
    RatiosCase c;
    c.code = code_test::kCodeVariants[rng.below(3)];
    c.position = rng.below(kPositionsPerAxis);
    int here = static_cast<int>(rng.below(kSections));
    for (int line = 0; line < lines; ++line) {
        c.rolls.push_back(here);
        here = (here + code_test::reference_delta(
                           c.code, std::uint64_t{c.position} + static_cast<unsigned>(line))) %
               63;
    }
    return c;
}

/// Returns a case at a random place, with lines of 6 to 11 bits. A tenth of the bits are wrong.
inline RatiosCase read_at_random(Rng& rng, int lines) {
    RatiosCase c = at_random_place(rng, lines);
    c.odds_q8 = 3 * 256;
    for (const int roll : c.rolls)
        c.storage.push_back(scored_line(roll, 6 + static_cast<int>(rng.below(6)), 0.1, 127, rng));
    return c;
}

/// The four places, one in each sequence, that correspond to one position.
using PlacesOfAlternative = std::array<std::uint32_t, 4>;

inline PlacesOfAlternative own_places(const RatiosCase& c) {
    const auto texts = code_test::secondary_texts(c.code);
    PlacesOfAlternative places;
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] = static_cast<std::uint32_t>(c.position % texts[k].size());
    return places;
}

/// Returns the rolls of the lines of the alternative at `places`, shifted so that line `shared` has
/// the same roll as in the reading.
inline std::vector<int> rolls_from(const RatiosCase& c, const PlacesOfAlternative& places,
                                   std::size_t shared) {
    const auto texts = code_test::secondary_texts(c.code);
    std::vector<int> rolls{0};
    for (std::size_t line = 0; line + 1 < c.rolls.size(); ++line) {
        int step = 5;
        for (std::size_t k = 0; k < places.size(); ++k) {
            step += code_test::kWeights[k] * (texts[k][(places[k] + line) % texts[k].size()] - '0');
        }
        rolls.push_back((rolls.back() + step) % 63);
    }
    const int further = c.rolls[shared] - rolls[shared] + 63;
    for (int& roll : rolls)
        roll = (roll + further) % 63;
    return rolls;
}

/// Returns the odds of a position with these rolls, relative to the reading. Odds below 2^-64 are
/// counted as 2^-64.
inline double odds_of_rolls(const RatiosCase& c, const std::vector<int>& rolls) {
    double lost = 0;
    for (std::size_t line = 0; line < rolls.size(); ++line) {
        const LineScores& scores = c.storage[line].scores;
        lost += scores[static_cast<std::size_t>(c.rolls[line])] -
                scores[static_cast<std::size_t>(rolls[line])];
    }
    return std::max(std::exp2(-lost * c.odds_q8 / 256 / 254), 0x1p-64);
}

/// Returns the first line in which `rolls` agrees with the rolls of the reading, or the number of
/// lines if there is none.
inline std::size_t first_shared(const RatiosCase& c, const std::vector<int>& rolls) {
    std::size_t line = 0;
    while (line < rolls.size() && rolls[line] != c.rolls[line])
        ++line;
    return line;
}

/// Returns the sum of the odds of all other places in one sequence. A place is counted once for
/// each shift at which it shares a line with the reading.
inline double sum_of_singles(const RatiosCase& c) {
    const auto texts = code_test::secondary_texts(c.code);
    const std::size_t count = c.rolls.size();
    double sum = 0;
    for (std::size_t k = 0; k < texts.size(); ++k) {
        const std::size_t length = texts[k].size();
        for (std::size_t place = 0; place < length; ++place) {
            if (place == c.position % length) continue;
            std::vector<int> rolls;  // rolls of the alternative at shift 0
            int offset = 0;
            for (std::size_t line = 0; line < count; ++line) {
                rolls.push_back(c.rolls[line] + offset);
                offset += code_test::kWeights[k] *
                          (code_test::digit_at(texts[k], place + line) -
                           code_test::digit_at(texts[k], c.position % length + line));
            }
            for (int shift = 0; shift < 63; ++shift) {
                bool shares = false;
                double lost = 0;
                for (std::size_t line = 0; line < count; ++line) {
                    const int other = ((rolls[line] + shift) % 63 + 63) % 63;
                    shares = shares || other == c.rolls[line];
                    lost += c.storage[line].scores[static_cast<std::size_t>(c.rolls[line])] -
                            c.storage[line].scores[static_cast<std::size_t>(other)];
                }
                // The loss is halved, because each bit that disagrees only with the alternative
                // reduces the score by twice its weight.
                if (shares) sum += std::exp2(-lost / 2 / 127 * c.odds_q8 / 256);
            }
        }
    }
    return sum;
}

}  // namespace dotpose::core_test

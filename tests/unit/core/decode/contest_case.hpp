// Lines as they are read, for the tests of what is counted of rivals.
#pragma once

#include <vector>

#include "../../code/reference.hpp"
#include "core/decode/contest.hpp"
#include "core/decode/correlation.hpp"
#include "dotpose/random.hpp"

namespace dotpose::core_test {

using namespace core;

/// Lines of the code from some position, read with some odds.
struct ContestCase {
    Profile profile;
    std::uint32_t position;
    std::vector<int> rolls;
    std::vector<ScoredLine> storage;
    int odds_q8;

    Lines lines() const { return {storage}; }
    AxisReading reading() const { return {position, static_cast<std::uint8_t>(rolls[0]), 0, 0}; }
    Contest contest() const { return {profile, lines(), reading(), odds_q8}; }
};

/// A line of `bits` bits of the main sequence, `wrong` of which are flipped, with weights up to
/// `most`.
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
    line.lead = lead_of(line.scores);
    return line;
}

/// Without its lines.
inline ContestCase at_random_place(Rng& rng, int lines) {
    ContestCase c;
    c.profile = code_test::kProfiles[rng.below(3)];
    c.position = rng.below(kPositionsPerAxis);
    int here = static_cast<int>(rng.below(kSections));
    for (int line = 0; line < lines; ++line) {
        c.rolls.push_back(here);
        here = (here + code_test::reference_delta(
                           c.profile, std::uint64_t{c.position} + static_cast<unsigned>(line))) %
               63;
    }
    return c;
}

}  // namespace dotpose::core_test

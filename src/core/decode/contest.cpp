#include "core/decode/contest.hpp"

namespace dotpose::core {

Contest::Contest(Profile profile, const Lines& lines_, const AxisReading& reading, int odds_q8)
    : basis(code::basis(profile)),
      lines(lines_),
      position(reading.position),
      odds_per_bit_q8_(odds_q8) {
    int most_regained = 0;  // score by which better rolls than the reading's exceed it, in all
    int roll = reading.roll;
    std::uint32_t p = reading.position;
    for (int i = 0; i < lines.count(); ++i) {
        rolls_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(roll);
        roll = (roll + delta(profile, p)) % kSections;
        p = p + 1 == kPositionsPerAxis ? 0 : p + 1;
        const LineScores& scores = lines[i];
        most_regained += *std::max_element(scores.begin(), scores.end()) -
                         scores[rolls_[static_cast<std::size_t>(i)]];
    }
    hopeless_score_ =
        most_regained + static_cast<int>(-std::int64_t{kNegligible_q8} * 2 * 127 / odds_q8);
}

}  // namespace dotpose::core

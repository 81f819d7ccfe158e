#include "core/decode/contest.hpp"

#include "code/rolls.hpp"

namespace dotpose::core {

Contest::Contest(Profile profile, const Lines& lines_, const AxisReading& reading, int odds_q8)
    : basis(code::basis(profile)),
      lines(lines_),
      position(reading.position),
      odds_per_bit_q8_(odds_q8) {
    const auto count = static_cast<std::size_t>(lines.count());
    code::follow_rolls(profile, reading.position, reading.roll, std::span(rolls_).first(count));
    for (int i = 0; i < lines.count(); ++i) {
        const LineScores& scores = lines[i];
        const std::size_t own = rolls_[static_cast<std::size_t>(i)];
        int best_other = INT16_MIN;
        for (std::size_t o = 0; o < scores.size(); ++o) {
            if (o != own) best_other = std::max<int>(best_other, scores[o]);
        }
        const int least_loss = scores[own] - best_other;
        least_losses_[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(least_loss);
        most_regained_ += std::max(-least_loss, 0);
    }
    hopeless_score_ = most_regained_ + -kNegligible_q8 * 2 * 127 / odds_q8;
}

Growth growth_of(const Contest& contest, const code::Secondary& a, std::uint32_t rival_place) {
    Growth growth;
    std::uint32_t own = contest.position % a.length;
    std::uint32_t rival = rival_place;
    int grown = 0;
    for (int line = 0; line < contest.lines.count(); ++line) {
        growth[static_cast<std::size_t>(line)] = static_cast<std::uint8_t>(grown);
        grown += a.weight * (a.digits[rival] - a.digits[own]);
        if (grown < 0) grown += kSections;
        if (grown >= kSections) grown -= kSections;
        own = own + 1 == a.length ? 0 : own + 1;
        rival = rival + 1 == a.length ? 0 : rival + 1;
    }
    return growth;
}

std::optional<int> loss_of_growth(const Contest& contest, const Growth& growth, int shared) {
    const int base = growth[static_cast<std::size_t>(shared)];
    const int count = contest.lines.count();
    int lost = 0;
    // Outwards from the shared line, where most is lost soonest; its predecessors last.
    for (int i = 1, line = shared + 1; i < count; ++i, ++line) {
        if (line == count) line = 0;
        const int shift = growth[static_cast<std::size_t>(line)] - base;
        if (shift == 0 && line < shared) return std::nullopt;
        lost += contest.loss(line, shift);
        if (contest.is_hopeless(lost)) break;
    }
    return lost;
}

}  // namespace dotpose::core

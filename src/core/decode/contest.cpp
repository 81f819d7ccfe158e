#include "core/decode/contest.hpp"

#include "code/rolls.hpp"

namespace dotpose::core {

Contest::Contest(Profile profile, const Lines& lines_, const AxisReading& reading, int odds_q8)
    : basis(code::basis(profile)),
      lines(lines_),
      position(reading.position),
      odds_per_bit_q8_(odds_q8) {
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] = basis[k].place_of(position);
    const auto count = static_cast<std::size_t>(lines.count());
    code::follow_rolls(profile, reading.position, reading.roll, std::span(rolls_).first(count));
    for (int i = 0; i < lines.count(); ++i) {
        const LineScores& scores = lines[i];
        const int own = scores[rolls_[static_cast<std::size_t>(i)]];
        const Lead lead = lines.lead(i);
        const int least_loss = own == lead.best ? lead.lead : own - lead.best;
        least_losses_[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(least_loss);
        most_regained_ += std::max(-least_loss, 0);
    }
    hopeless_score_ = most_regained_ + -kNegligible_q8 * 2 * 127 / odds_q8;
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

#include "core/decode/contest.hpp"

#include <algorithm>
#include <bit>

#include "code/rolls.hpp"
#include "code/tables.hpp"

namespace dotpose::core {

namespace {

/// Score of a full bit that is lost: what it was worth, and as much against it.
constexpr int kScoreOfBit = 2 * 127;

/// The least number of bits by which a stretch of the main sequence, by its first index and its
/// length, differs from those of the same length elsewhere.
constexpr auto kLeastDistances = [] {
    std::array<std::array<std::uint8_t, kMostTracked + 1>, kSections> least{};
    for (std::size_t first = 0; first < least.size(); ++first) {
        least[first].fill(kMostTracked);
        for (std::size_t other = 0; other < kSections; ++other) {
            if (other == first) continue;
            std::uint8_t distance = 0;
            for (std::size_t length = 0;; ++length) {
                least[first][length] = std::min(least[first][length], distance);
                if (length == kMostTracked) break;
                if (code::kMainRepeated[first + length] != code::kMainRepeated[other + length])
                    ++distance;
            }
        }
    }
    return least;
}();

/// Bits that who puts a line at another roll contradicts at least more than who puts it at `roll`.
/// Those not read might all be among those that differ, and so might those that are wrong.
int least_lost_bits(const TrackedLine& line, int roll) {
    if (line.seen == 0) return 0;
    const int first = std::countr_zero(line.seen);
    const int length = static_cast<int>(std::bit_width(line.seen)) - first;
    const int unread = length - bits_in(line.seen);
    const int begin = roll + first < kSections ? roll + first : roll + first - kSections;
    const int distance =
        kLeastDistances[static_cast<std::size_t>(begin)][static_cast<std::size_t>(length)];
    const int wrong = bits_in(line.wrong);
    return std::max(distance - unread, wrong) - 2 * wrong;
}

}  // namespace

Contest::Contest(Profile profile, const Lines& lines_, const AxisReading& reading, int odds_q8)
    : basis(code::basis(profile)),
      lines(lines_),
      position(reading.position),
      count_(lines_.count()),
      odds_per_bit_q8_(odds_q8) {
    follow_rolls(profile, reading);
    for (int i = 0; i < count_; ++i) {
        const LineScores& scores = lines[i];
        const int own = scores[rolls_[static_cast<std::size_t>(i)]];
        const Lead lead = lines.lead(i);
        set_least_loss(i, own == lead.best ? lead.lead : own - lead.best);
    }
    hopeless_score_ = most_regained_ + -kNegligible_q8 * 2 * 127 / odds_q8;
}

Contest::Contest(Profile profile, std::span<const TrackedLine> lines_, const AxisReading& reading,
                 int odds_q8)
    : basis(code::basis(profile)),
      position(reading.position),
      bits_(lines_),
      count_(static_cast<int>(lines_.size())),
      odds_per_bit_q8_(odds_q8) {
    follow_rolls(profile, reading);
    for (int i = 0; i < count_; ++i) {
        const auto line = static_cast<std::size_t>(i);
        set_least_loss(i, kScoreOfBit * least_lost_bits(bits_[line], rolls_[line]));
    }
    hopeless_score_ = most_regained_ + -kNegligible_q8 * 2 * 127 / odds_q8;
}

void Contest::follow_rolls(Profile profile, const AxisReading& reading) {
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] = basis[k].place_of(position);
    code::follow_rolls(profile, reading.position, reading.roll,
                       std::span(rolls_).first(static_cast<std::size_t>(count_)));
}

void Contest::set_least_loss(int line, int least_loss) {
    least_losses_[static_cast<std::size_t>(line)] = static_cast<std::int16_t>(least_loss);
    most_regained_ += std::max(-least_loss, 0);
}

int Contest::loss_of_bits(int line, int roll) const {
    const TrackedLine& bits = bits_[static_cast<std::size_t>(line)];
    const std::uint32_t differ =
        (bits.code ^ code::kMainWords[static_cast<std::size_t>(roll)]) & bits.seen;
    return kScoreOfBit * (bits_in(differ) - 2 * bits_in(differ & bits.wrong));
}

std::optional<int> loss_of_growth(const Contest& contest, const Growth& growth, int shared) {
    return loss_of_growth(contest, growth, shared,
                          [&](int line, int shift) { return contest.loss(line, shift); });
}

}  // namespace dotpose::core

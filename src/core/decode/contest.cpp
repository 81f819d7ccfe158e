#include "core/decode/contest.hpp"

#include <algorithm>
#include <bit>

#include "code/rolls.hpp"
#include "code/tables.hpp"

namespace dotpose::core {

namespace {

/// Score of a full bit that is lost: what it was worth, and as much against it.
constexpr int kScoreOfBit = 2 * 127;

/// Bits in which two stretches of the main sequence differ, by their first indices.
constexpr int distance_of(std::size_t first, std::size_t other, std::size_t length) {
    const std::uint32_t all = length == 0 ? 0 : ~std::uint32_t{0} >> (32 - length);
    return bits_in((code::kMainWords[first] ^ code::kMainWords[other]) & all);
}

/// Of the stretches of a length that differ from one in the fewest bits: in how many, and how many
/// there are.
struct Nearest {
    int distance = kMostTracked + 1;
    int count = 0;
};
constexpr Nearest nearest_of(std::size_t first, std::size_t length) {
    Nearest nearest;
    for (std::size_t other = 0; other < kSections; ++other) {
        if (other == first) continue;
        const int distance = distance_of(first, other, length);
        if (distance < nearest.distance) nearest = {distance, 0};
        if (distance == nearest.distance) ++nearest.count;
    }
    return nearest;
}

/// The least number of bits by which a stretch of the main sequence, by its first index and its
/// length, differs from those of the same length elsewhere.
constexpr auto kLeastDistances = [] {
    std::array<std::array<std::uint8_t, kMostTracked + 1>, kSections> least{};
    for (std::size_t first = 0; first < least.size(); ++first) {
        for (std::size_t length = 0; length < least[first].size(); ++length)
            least[first][length] = static_cast<std::uint8_t>(nearest_of(first, length).distance);
    }
    return least;
}();

/// By the length of a stretch: log2 of the number of others that differ from it in the fewest bits,
/// at most, in 2^-8, rounded up.
constexpr auto kLog2OfNearest = [] {
    std::array<std::uint16_t, kMostTracked + 1> log2{};
    for (std::size_t length = 0; length < log2.size(); ++length) {
        int most = 1;
        for (std::size_t first = 0; first < kSections; ++first)
            most = std::max(most, nearest_of(first, length).count);
        // log2(1 + f) is at most f + 0.087.
        const int whole = std::bit_width(static_cast<unsigned>(most)) - 1;
        log2[length] = static_cast<std::uint16_t>(256 * whole + ((most << 8 >> whole) - 256) + 23);
    }
    return log2;
}();

/// log2 of 62, likewise.
constexpr int kLog2OfOthers_q8 = 1525;

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

int Contest::log2_of_nearest_q8(int line) const {
    const TrackedLine& bits = bits_[static_cast<std::size_t>(line)];
    if (bits.seen == 0) return kLog2OfOthers_q8;
    const int length = static_cast<int>(std::bit_width(bits.seen)) - std::countr_zero(bits.seen);
    // Where bits are wrong or were not read, others may come as near.
    if (bits.wrong != 0 || bits_in(bits.seen) != length) return kLog2OfOthers_q8;
    // All others lose one bit more.
    return std::min(add_log2(kLog2OfNearest[static_cast<std::size_t>(length)],
                             kLog2OfOthers_q8 - odds_per_bit_q8_),
                    kLog2OfOthers_q8);
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

#include "core/integrity/likelihood_ratios.hpp"

#include <algorithm>
#include <bit>

#include "code/rolls.hpp"
#include "code/tables.hpp"

namespace dotpose::core {

namespace {

/// Returns the Hamming distance between two substrings of the main sequence. The substrings begin
/// at the bits `first` and `other`, and have `length` bits.
constexpr int distance_of(std::size_t first, std::size_t other, std::size_t length) {
    const std::uint32_t all = length == 0 ? 0 : ~std::uint32_t{0} >> (32 - length);
    return bits_in((code::kMainWords[first] ^ code::kMainWords[other]) & all);
}

/// Minimum Hamming distance between a substring of the main sequence and all other substrings of
/// the same length, and the number of substrings at this distance.
struct NearestSubstrings {
    int distance = kMaxComparedLines + 1;
    int count = 0;

    constexpr void add(int other_distance) {
        if (other_distance < distance) *this = {other_distance, 0};
        if (other_distance == distance) ++count;
    }
};
constexpr NearestSubstrings nearest_of(std::size_t first, std::size_t length) {
    NearestSubstrings nearest;
    for (std::size_t other = 0; other < kSections; ++other) {
        if (other != first) nearest.add(distance_of(first, other, length));
    }
    return nearest;
}

/// Minimum distances of substrings of all lengths, indexed by the first bit of the substring. Bit i
/// is 1 if the minimum distance for i + 1 bits is larger than for i bits. Each additional bit
/// increases the minimum distance by at most 1, so the minimum distance for n bits is the number of
/// ones in the first n bits.
constexpr auto kGrowingDistances = [] {
    std::array<std::uint32_t, kSections> grows{};
    for (std::size_t first = 0; first < grows.size(); ++first) {
        int before = 0;
        for (std::size_t i = 0; i < kMaxComparedLines; ++i) {
            const int distance = nearest_of(first, i + 1).distance;
            if (distance > before) grows[first] |= std::uint32_t{1} << i;
            before = distance;
        }
    }
    return grows;
}();
static_assert([] {
    for (std::size_t first = 0; first < kSections; ++first) {
        const int distance = nearest_of(first, kMaxComparedLines).distance;
        if (bits_in(kGrowingDistances[first]) != distance) return false;
    }
    return true;
}());

/// Upper bounds on log2 of `NearestSubstrings::count` for each substring length, in units of 2^-8.
constexpr auto kLog2OfNearest = [] {
    std::array<std::uint16_t, kMaxComparedLines + 1> log2{};
    for (std::size_t length = 0; length < log2.size(); ++length) {
        int max_count = 1;
        for (std::size_t first = 0; first < kSections; ++first)
            max_count = std::max(max_count, nearest_of(first, length).count);
        log2[length] =
            static_cast<std::uint16_t>(log2_at_most_q8(static_cast<std::uint32_t>(max_count)));
    }
    return log2;
}();

}  // namespace

LikelihoodRatios::LikelihoodRatios(CodeVariant code, const Lines& lines_,
                                   const AxisReading& reading, int odds_q8)
    : basis(code::basis(code)),
      lines(lines_),
      position(reading.position),
      count_(lines_.count()),
      odds_per_bit_q8_(odds_q8) {
    follow_rolls(code, reading);
    for (int i = 0; i < count_; ++i) {
        const LineScores& scores = lines[i];
        const int own = scores[rolls_[static_cast<std::size_t>(i)]];
        const BestScore best = lines.best(i);
        set_min_loss(i, own == best.score ? best.margin : own - best.score);
    }
    hopeless_score_ = max_gain_ + -kNegligible_q8 * 2 * 127 / odds_q8;
}

LikelihoodRatios::LikelihoodRatios(CodeVariant code, std::span<const ComparedLine> lines_,
                                   const AxisReading& reading, int odds_q8)
    : basis(code::basis(code)),
      position(reading.position),
      bits_(lines_),
      count_(static_cast<int>(lines_.size())),
      odds_per_bit_q8_(odds_q8) {
    follow_rolls(code, reading);
    set_min_losses_of_bits();
}

LikelihoodRatios::LikelihoodRatios(CodeVariant code, std::span<const ComparedLine> lines_,
                                   const AxisReading& reading, int odds_q8,
                                   std::span<const std::uint8_t> rolls)
    : basis(code::basis(code)),
      position(reading.position),
      bits_(lines_),
      count_(static_cast<int>(lines_.size())),
      odds_per_bit_q8_(odds_q8) {
    find_places();
    std::copy(rolls.begin(), rolls.end(), rolls_.begin());
    set_min_losses_of_bits();
}

void LikelihoodRatios::set_min_losses_of_bits() {
    for (int i = 0; i < count_; ++i) {
        const auto line = static_cast<std::size_t>(i);
        const Nearest others = bits_[line].seen != 0 ? nearest(i) : Nearest{0, kOtherRolls_q8};
        set_min_loss(i, kScoreOfBit * others.lost_bits);
        log2_of_nearest_q8_[line] = static_cast<std::int16_t>(others.log2_count_q8);
    }
    hopeless_score_ = max_gain_ + -kNegligible_q8 * 2 * 127 / odds_per_bit_q8_;
}

int LikelihoodRatios::log2_of_nearest_q8(int line) const {
    // Fewer than 62 rolls are neither the roll of the reading nor one of the nearest rolls. Each of
    // these other rolls loses at least one more bit than the nearest rolls.
    const int log2_q8 = add_log2(log2_of_nearest_q8_[static_cast<std::size_t>(line)],
                                 kOtherRolls_q8 - odds_per_bit_q8_);
    return std::min(log2_q8, kOtherRolls_q8);
}

void LikelihoodRatios::follow_rolls(CodeVariant code, const AxisReading& reading) {
    find_places();
    code::follow_rolls(code, reading.position, reading.roll,
                       std::span(rolls_).first(static_cast<std::size_t>(count_)));
}

void LikelihoodRatios::find_places() {
    for (std::size_t k = 0; k < places.size(); ++k)
        places[k] = basis[k].place_of(position);
}

void LikelihoodRatios::set_min_loss(int line, int min_loss) {
    min_losses_[static_cast<std::size_t>(line)] = static_cast<std::int16_t>(min_loss);
    max_gain_ += std::max(-min_loss, 0);
}

LikelihoodRatios::Nearest LikelihoodRatios::nearest(int line) const {
    const ComparedLine& bits = bits_[static_cast<std::size_t>(line)];
    const int own = own_roll(line);
    const int first = std::countr_zero(bits.seen);
    const int length = static_cast<int>(std::bit_width(bits.seen)) - first;
    const std::uint32_t read = bits.seen >> first;
    if (bits.wrong == 0 && (read & (read + 1)) == 0) {
        const int begin = own + first < kSections ? own + first : own + first - kSections;
        const std::uint32_t grows = kGrowingDistances[static_cast<std::size_t>(begin)];
        return {bits_in(grows & read), kLog2OfNearest[static_cast<std::size_t>(length)]};
    }
    // The tables do not cover lines with gaps or wrong bits.
    NearestSubstrings nearest;
    for (int roll = 0; roll < kSections; ++roll) {
        if (roll != own) nearest.add(loss_of_bits(line, roll));
    }
    return {nearest.distance, log2_at_most_q8(static_cast<std::uint32_t>(nearest.count))};
}

int LikelihoodRatios::loss_of_bits(int line, int roll) const {
    const ComparedLine& bits = bits_[static_cast<std::size_t>(line)];
    const std::uint32_t differ =
        (bits.code ^ code::kMainWords[static_cast<std::size_t>(roll)]) & bits.seen;
    const std::uint32_t corrected = differ & bits.wrong;
    return bits_in(differ) - (corrected != 0 ? 2 * bits_in(corrected) : 0);
}

std::optional<int> loss_of_offsets(const LikelihoodRatios& ratios, const RollOffsets& offsets,
                                   int shared) {
    const int base = offsets[static_cast<std::size_t>(shared)];
    const int count = ratios.count();
    int lost = 0;
    // Visits the lines after `shared` first, then the lines before it.
    for (int i = 1, line = shared + 1; i < count; ++i, ++line) {
        if (line == count) line = 0;
        const int shift = offsets[static_cast<std::size_t>(line)] - base;
        if (shift == 0 && line < shared) return std::nullopt;
        lost += ratios.loss(line, shift);
        if (ratios.is_hopeless(lost)) break;
    }
    return lost;
}

}  // namespace dotpose::core

// Known odds: bounds the probability that a place on the known sheets is wrong. See
// docs/integrity.md, "Known sheets".
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/integrity/confidence.hpp"
#include "core/integrity/known_lines.hpp"
#include "core/integrity/known_places.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// Odds of a position relative to the tested position. All bits have the same weight, so log2 of
/// the odds is linear in the number of bits that agree with the code.
class OddsOfBits {
  public:
    /// `agreeing` is the number of bits that agree with the code at the tested position.
    OddsOfBits(int odds_per_bit_q8, int agreeing)
        : agreeing_(agreeing),
          // Clamps the odds to [2^-52, 2^60]. If the odds of a position on one axis exceed 2^60,
          // the tested place is always rejected, because the product of these odds and the minimum
          // odds on the other axis exceeds 1.
          min_(-52 * 256 / odds_per_bit_q8 - 1),
          max_(60 * 256 / odds_per_bit_q8),
          per_bit_(odds_per_bit_q8 << 15) {}

    /// Returns the odds of a position where `agreeing` bits agree with the code. Interpolates
    /// linearly between powers of two, so the result is at most 6.2 % too large.
    float operator()(int agreeing) const {
        const int more = std::clamp(agreeing - agreeing_, min_, max_);
        return __builtin_bit_cast(float, kOne + more * per_bit_);
    }

  private:
    static constexpr int kOne = 127 << 23;  // bit pattern of 1.0F
    int agreeing_;
    int min_;
    int max_;
    int per_bit_;  ///< log2 of the odds per bit, in units of 2^-23
};

/// Position of the first line of a block. The roll of each line is its roll in section 0 plus
/// `roll`, modulo 63.
struct PositionAndRoll {
    std::uint32_t position;
    std::size_t roll;
};

/// Summed odds of the positions in a range, for each class and each value of
/// `PositionAndRoll::roll`. The class of a position is the position modulo 63. The sums exclude the
/// position and roll in `left_out`, if given.
class OddsByClass {
  public:
    OddsByClass(const ScoredAxis& axis, CodeVariant code, const PositionRange& range,
                const OddsOfBits& odds_of,
                const std::optional<PositionAndRoll>& left_out = std::nullopt) {
        for (auto& odds : odds_)
            odds.fill(0);
        axis.visit(code, range, [&](std::uint32_t position, const RollSums& sums) {
            auto& odds = odds_[class_of(position)];
            const bool leaves_out = left_out && position == left_out->position;
            const float before = leaves_out ? odds[left_out->roll] : 0;
            for (std::size_t roll = 0; roll < odds.size(); ++roll)
                odds[roll] += odds_of(sums[roll]);
            if (leaves_out) odds[left_out->roll] = before;
        });
    }
    float operator()(std::size_t of_class, std::size_t roll) const { return odds_[of_class][roll]; }

  private:
    std::array<std::array<float, kRollEntries>, kSections> odds_;
};

/// Returns an upper bound on the probability that at most `wrong` of `bits` random bits disagree
/// with the code at a given place. With n = `bits` and e = `wrong`:
///     sum over k <= e of C(n, k) 2^-n <= C(n, e) 2^-n / (1 - e / (n - e + 1))
/// Returns 1 if at least a third of the bits are wrong.
float random_agreement(int bits, int wrong) {
    if (3 * wrong >= bits) return 1;
    float term = 1;  // probability of exactly k wrong bits, divided by 2^exponent
    int exponent = -bits;
    for (int k = 0; k < wrong; ++k) {
        int growth = 0;
        term = std::frexp(term * static_cast<float>(bits - k) / static_cast<float>(k + 1), &growth);
        exponent += growth;
    }
    const float ratio = static_cast<float>(wrong) / static_cast<float>(bits - wrong + 1);
    return term * power_of_two_exactly(exponent) / (1 - ratio);
}

/// Returns an upper bound on the probability of a chance match. In a chance match, a view that
/// shows no known sheet agrees with at least one known place at least as well as the bits that were
/// read. The bits of such a view are assumed to be random. `bits` is the number of bits per axis,
/// and `wrong` is the number of wrong bits on each axis. `lines` is the number of columns or rows,
/// whichever is larger.
float chance_of_known(const KnownSheets& sheets, int bits, const std::array<int, 2>& wrong,
                      int lines) {
    float places = 0;
    float columns = 0;
    float rows = 0;
    for (const KnownRegion& region : sheets.regions) {
        const PositionRange x(region.first.x, region.columns, lines);
        const PositionRange y(region.first.y, region.rows, lines);
        places += static_cast<float>(x.count) * static_cast<float>(y.count);
        columns += static_cast<float>(x.count / kSections + 1);
        rows += static_cast<float>(y.count / kSections + 1);
    }
    // A tracked attempt tests only one place, but chooses among up to 2^10 planes. The bound
    // therefore assumes at least 2^10 trials.
    const float trials = std::max(kTurns * places, 1024.0F);
    const float anywhere = trials * random_agreement(2 * bits, wrong[0] + wrong[1]);
    if (sheets.are_all()) return anywhere;
    // An unknown sheet may have the same rows as a known sheet. All y bits then agree with the code
    // and determine the orientation, the roll and the row position, so only the columns of one
    // class remain possible. Likewise, if an unknown sheet has the same columns, only the rows of
    // one class remain possible.
    return anywhere + columns * random_agreement(bits, wrong[0]) +
           rows * random_agreement(bits, wrong[1]);
}

/// The place where the first column and the first row of a block cross.
struct CornerPlace {
    CodeVariant code;
    Place place;

    PositionAndRoll column() const {
        return {place.cell.x, sum_of_rolls(place.section.u, class_of(place.cell.y))};
    }
    PositionAndRoll row() const {
        return {place.cell.y, sum_of_rolls(place.section.v, class_of(place.cell.x))};
    }
};

/// Returns the summed odds of all places in a region.
float sum_of_odds(const KnownRegion& region, const OddsByClass& columns, const OddsByClass& rows) {
    float sum = 0;
    visit_classes(region.section, [&](std::size_t column, std::size_t column_roll, std::size_t row,
                                      std::size_t row_roll) {
        sum += columns(column, column_roll) * rows(row, row_roll);
    });
    return sum;
}

/// Returns the summed odds of all places in a region except `best`. The region must contain `best`,
/// and the odds of `best` are 1.
float sum_of_others(const KnownRegion& region, const ScoredTurn& turn, const OddsOfBits& x_odds,
                    const OddsOfBits& y_odds, const CornerPlace& best) {
    const auto [x, column_roll] = best.column();
    const auto [y, row_roll] = best.row();
    const OddsByClass columns(turn.columns, region.code, turn.columns_of(region), x_odds,
                              best.column());
    const OddsByClass rows(turn.rows, region.code, turn.rows_of(region), y_odds, best.row());
    // `columns` and `rows` exclude the column and the row of `best`, whose odds are 1. The second
    // term is the odds of the places in the row of `best` and in another column of the same class.
    // The third term is the odds of the places in the column of `best` and in another row of the
    // same class.
    return sum_of_odds(region, columns, rows) + columns(class_of(x), column_roll) +
           rows(class_of(y), row_roll);
}

}  // namespace

float known_place_wrong(const Kernels& kernels, const BitBlock& block, const KnownSheets& sheets,
                        CodeVariant code, const Place& place, int bits_per_error) {
    // Number of bits per axis. The number is the same for x and y.
    const int bits = number_of_bits(block.columns);
    const ScoredTurn upright(kernels, block);
    const CornerPlace best{code, moved(code, place, upright.columns_range.first - BitBlock::kMiddle,
                                       upright.rows_range.first - BitBlock::kMiddle)};
    const int x_agreeing =
        upright.columns.agreeing(code, best.column().position, best.column().roll);
    const int y_agreeing = upright.rows.agreeing(code, best.row().position, best.row().roll);
    const std::array wrong{bits - x_agreeing, bits - y_agreeing};
    const int odds_q8 =
        odds_per_bit_q8(Confidence::of_hard_bits(2 * bits, wrong[0] + wrong[1]), bits_per_error);
    if (odds_q8 == 0) return 1;
    const OddsOfBits x_odds(odds_q8, x_agreeing);
    const OddsOfBits y_odds(odds_q8, y_agreeing);
    float others = 0;
    bool is_included = false;
    for (int quarters = 0; quarters < kTurns; ++quarters) {
        const ScoredTurn turn(kernels, turned(quarters, block));
        KeptTable<OddsByClass> columns;
        KeptTable<OddsByClass> rows;
        for (const KnownRegion& region : sheets.regions) {
            const PositionRange x = turn.columns_of(region);
            const PositionRange y = turn.rows_of(region);
            // Several regions may contain `best`, because regions may overlap.
            const bool has_best = quarters == 0 && region.code == code &&
                                  region.section == best.place.section &&
                                  x.contains(best.place.cell.x) && y.contains(best.place.cell.y);
            is_included |= has_best;
            others += has_best
                          ? sum_of_others(region, turn, x_odds, y_odds, best)
                          : sum_of_odds(region, columns.of(turn.columns, region.code, x, x_odds),
                                        rows.of(turn.rows, region.code, y, y_odds));
        }
    }
    const int lines = std::max(upright.columns.count(), upright.rows.count());
    return is_included ? std::min(others + chance_of_known(sheets, bits, wrong, lines), 1.0F) : 1;
}

}  // namespace dotpose::core

#include "core/integrity/known_places.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "code/rolls.hpp"
#include "code/tables.hpp"
#include "core/integrity/confidence.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

constexpr int kTurns = 4;

std::size_t class_of(std::uint32_t position) {
    return code::modulo_sections(position);
}

std::size_t sum_of_rolls(std::size_t a, std::size_t b) {
    const std::size_t sum = a + b;
    return sum < kSections ? sum : sum - kSections;
}

/// The lines of one axis of an upright block, with the number of bits that agree with each roll.
class ScoredAxis {
  public:
    ScoredAxis(const Kernels& kernels, const BitLines& lines, const LineRange& range,
               int first_cell)
        : kernels_(kernels) {
        constexpr int kWeight = 127;
        scores_.count = range.count;
        for (int i = 0; i < range.count; ++i) {
            const auto line = static_cast<std::size_t>(range.first + i);
            ScoredLine scored;
            kernels.score_line(lines.bits[line] >> first_cell, lines.valid[line] >> first_cell,
                               scored);
            const int bits = std::popcount(lines.valid[line]);
            auto& twice = scores_.lines[static_cast<std::size_t>(i)];
            for (std::size_t roll = 0; roll < kSections; ++roll)
                twice[roll] =
                    static_cast<std::uint16_t>((scored.scores[roll] / kWeight + bits) / 2);
            std::copy_n(twice.begin(), kSections, twice.begin() + kSections);
            std::fill(twice.begin() + 2 * kSections, twice.end(), std::uint16_t{0});
        }
    }

    int count() const { return scores_.count; }

    /// Returns the number of bits that agree with the code if the first line is at `position` and
    /// its rolls are those of section 0 plus `added`.
    int agreeing(CodeVariant code, std::uint32_t position, std::size_t added) const {
        std::array<std::uint8_t, BitBlock::kSide> rolls;
        code::follow_rolls(code, position, roll(code, position),
                           std::span(rolls).first(static_cast<std::size_t>(count())));
        int sum = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count()); ++i)
            sum += scores_.lines[i][rolls[i] + added];
        return sum;
    }

    /// Calls `use(position, sums)` for each position of the first line. The sums are by the roll
    /// that section and crossing line add to the rolls of the lines in section 0.
    template <typename Use>
    void visit(CodeVariant code, const PositionRange& range, Use use) const {
        constexpr std::uint32_t kChunk = 63;
        std::array<std::uint8_t, kChunk + BitBlock::kSide> rolls;
        std::array<RollSums, kChunk> sums;
        for (std::uint32_t done = 0; done < range.count; done += kChunk) {
            const std::uint32_t first = range.first + done;
            const std::uint32_t chunk = std::min(kChunk, range.count - done);
            code::follow_rolls(code, first, roll(code, first),
                               std::span(rolls).first(chunk + static_cast<std::size_t>(count())));
            kernels_.sum_rolls(scores_, rolls.data(), static_cast<int>(chunk), sums.data());
            for (std::uint32_t i = 0; i < chunk; ++i)
                use(first + i, sums[i]);
        }
    }

  private:
    const Kernels& kernels_;
    RollScores scores_;
};

/// The scored lines of a block in one turn.
struct ScoredTurn {
    LineRange columns_range;
    LineRange rows_range;
    ScoredAxis columns;
    ScoredAxis rows;

    ScoredTurn(const Kernels& kernels, const BitBlock& upright)
        : ScoredTurn(kernels, upright, ranges_with_bits(upright, BitBlock::kSide)) {}
    ScoredTurn(const Kernels& kernels, const BitBlock& upright, const BlockRanges& ranges)
        : columns_range(ranges.columns),
          rows_range(ranges.rows),
          columns(kernels, upright.columns, ranges.columns, ranges.rows.first),
          rows(kernels, upright.rows, ranges.rows, ranges.columns.first) {}

    PositionRange columns_of(const KnownRegion& region) const {
        return {region.first.x, region.columns, columns.count()};
    }
    PositionRange rows_of(const KnownRegion& region) const {
        return {region.first.y, region.rows, rows.count()};
    }
};

/// The table of one axis of a region. It is kept for the next region, which often has the same
/// columns or rows, because the sheets of a file are side by side.
template <typename Table>
class KeptTable {
  public:
    template <typename... Rest>
    const Table& of(const ScoredAxis& axis, CodeVariant code, const PositionRange& range,
                    const Rest&... rest) {
        if (!table_ || code != code_ || range != range_) table_.emplace(axis, code, range, rest...);
        code_ = code;
        range_ = range;
        return *table_;
    }

  private:
    CodeVariant code_ = CodeVariant::anoto;
    PositionRange range_{0, 1, 1};
    std::optional<Table> table_;
};

/// Calls `use` with each pair of a column class, its roll, a row class and its roll. The rolls of
/// columns depend on the row modulo 63 only, and those of rows on the column modulo 63.
template <typename Use>
void visit_classes(const Section& section, Use use) {
    for (std::size_t column = 0; column < kSections; ++column) {
        const std::size_t row_roll = sum_of_rolls(section.v, column);
        for (std::size_t row = 0; row < kSections; ++row)
            use(column, sum_of_rolls(section.u, row), row, row_roll);
    }
}

/// Largest sums of the positions of each class modulo 63.
class Peaks {
  public:
    Peaks(const ScoredAxis& axis, CodeVariant code, const PositionRange& range) {
        for (RollSums& sums : best_)
            sums.fill(0);
        axis.visit(code, range, [&](std::uint32_t position, const RollSums& sums) {
            RollSums& best = best_[class_of(position)];
            for (std::size_t roll = 0; roll < best.size(); ++roll)
                best[roll] = std::max(best[roll], sums[roll]);
        });
    }
    /// Returns the largest sum of a class at a roll; 0 without a position of the class.
    int operator()(std::size_t of_class, std::size_t roll) const { return best_[of_class][roll]; }

  private:
    std::array<RollSums, kSections> best_;
};

/// Returns the first position of a class that has a sum at a roll.
std::uint32_t position_with(const ScoredAxis& axis, CodeVariant code, const PositionRange& range,
                            std::size_t of_class, std::size_t roll, int sum) {
    std::uint32_t found = range.first;
    bool is_found = false;
    axis.visit(code, range, [&](std::uint32_t position, const RollSums& sums) {
        if (is_found || class_of(position) != of_class || sums[roll] != sum) return;
        found = position;
        is_found = true;
    });
    return found;
}

int bits_of(const BitLines& lines) {
    int bits = 0;
    for (const std::uint64_t valid : lines.valid)
        bits += std::popcount(valid);
    return bits;
}

/// Odds of a position relative to the place that is judged, by the number of bits that agree. Each
/// bit counts as much, so the logarithm is linear.
class OddsOfBits {
  public:
    /// `agreeing` is the number of bits that agree with the place judged.
    OddsOfBits(int odds_per_bit_q8, int agreeing)
        : agreeing_(agreeing),
          // Odds below the first limit count as that limit. Odds above the second limit refuse the
          // place in any case, because their products with the first limit do.
          min_(-52 * 256 / odds_per_bit_q8 - 1),
          max_(60 * 256 / odds_per_bit_q8),
          per_bit_(odds_per_bit_q8 << 15) {}

    /// Interpolates linearly between powers of two, which exceeds the exact odds by up to 9 %.
    float operator()(int agreeing) const {
        const int more = std::clamp(agreeing - agreeing_, min_, max_);
        return __builtin_bit_cast(float, kOne + more * per_bit_);
    }

  private:
    static constexpr int kOne = 127 << 23;  // the bits of 1.0F
    int agreeing_;
    int min_;
    int max_;
    int per_bit_;  ///< log2 of the odds of a bit, in 2^-23
};

/// A position of the first line, and a roll.
struct PositionAndRoll {
    std::uint32_t position;
    std::size_t roll;
};

/// Sums of the odds of the positions of each class modulo 63.
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

/// Returns an upper bound of the probability that at most `wrong` of `bits` random bits contradict
/// one place. The terms of the binomial sum fall at least as fast as a geometric series.
float random_agreement(int bits, int wrong) {
    if (3 * wrong >= bits) return 1;
    float term = 1;  // number of combinations of k wrong bits, divided by 2^exponent
    int exponent = -bits;
    for (int k = 0; k < wrong; ++k) {
        int growth = 0;
        term = std::frexp(term * static_cast<float>(bits - k) / static_cast<float>(k + 1), &growth);
        exponent += growth;
    }
    const float ratio = static_cast<float>(wrong) / static_cast<float>(bits - wrong + 1);
    return term * power_of_two_exactly(exponent) / (1 - ratio);
}

/// Returns the probability that the bits of a view that is on none of the sheets agree with a place
/// on them. `bits` is the number of bits of each axis, `lines` the largest number of lines.
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
    // A tracked attempt tests one place, but chooses among up to 2^10 planes.
    const float trials = std::max(kTurns * places, 1024.0F);
    const float anywhere = trials * random_agreement(2 * bits, wrong[0] + wrong[1]);
    if (sheets.are_all()) return anywhere;
    // An unknown sheet may have the columns or the rows of a known one. The bits of one axis then
    // agree, and they determine turn, roll and position of that axis.
    return anywhere + columns * random_agreement(bits, wrong[0]) +
           rows * random_agreement(bits, wrong[1]);
}

/// The place of the first column and the first row of a block.
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

/// Returns the sum of the odds of all places of a region, given the odds of its columns and rows.
float sum_of_odds(const KnownRegion& region, const OddsByClass& columns, const OddsByClass& rows) {
    float sum = 0;
    visit_classes(region.section, [&](std::size_t column, std::size_t column_roll, std::size_t row,
                                      std::size_t row_roll) {
        sum += columns(column, column_roll) * rows(row, row_roll);
    });
    return sum;
}

/// Returns the same sum without `best`, which is on the region and has the odds 1.
float sum_of_others(const KnownRegion& region, const ScoredTurn& turn, const OddsOfBits& x_odds,
                    const OddsOfBits& y_odds, const CornerPlace& best) {
    const auto [x, column_roll] = best.column();
    const auto [y, row_roll] = best.row();
    const OddsByClass columns(turn.columns, region.code, turn.columns_of(region), x_odds,
                              best.column());
    const OddsByClass rows(turn.rows, region.code, turn.rows_of(region), y_odds, best.row());
    // The last terms are the best column with other rows of the class of the best row, and the
    // reverse.
    return sum_of_odds(region, columns, rows) + columns(class_of(x), column_roll) +
           rows(class_of(y), row_roll);
}

}  // namespace

bool shows_sheet(const KnownSheets& sheets, CodeVariant code, const Place& place,
                 const BitBlock& block) {
    const auto [columns, rows] = ranges_with_bits(block, BitBlock::kSide);
    const Place corner =
        moved(code, place, columns.first - BitBlock::kMiddle, rows.first - BitBlock::kMiddle);
    return sheets.show(code, corner, columns.count, rows.count);
}

std::optional<KnownPlace> find_known_place(const Kernels& kernels, const BitBlock& block,
                                           const KnownSheets& sheets) {
    KnownPlace best;
    best.bits = bits_of(block.columns) + bits_of(block.rows);
    if (best.bits == 0) return {};
    int best_sum = -1;
    for (int quarters = 0; quarters < kTurns; ++quarters) {
        const ScoredTurn turn(kernels, turned(quarters, block));
        KeptTable<Peaks> kept_columns;
        KeptTable<Peaks> kept_rows;
        for (const KnownRegion& region : sheets.regions) {
            const Peaks& columns =
                kept_columns.of(turn.columns, region.code, turn.columns_of(region));
            const Peaks& rows = kept_rows.of(turn.rows, region.code, turn.rows_of(region));
            struct Classes {
                std::size_t column, column_roll, row, row_roll;
            } peak{};
            bool is_better = false;
            visit_classes(region.section, [&](std::size_t column, std::size_t column_roll,
                                              std::size_t row, std::size_t row_roll) {
                const int sum = columns(column, column_roll) + rows(row, row_roll);
                if (sum <= best_sum) return;
                best_sum = sum;
                is_better = true;
                peak = {column, column_roll, row, row_roll};
            });
            if (!is_better) continue;
            const int x_sum = columns(peak.column, peak.column_roll);
            const int y_sum = rows(peak.row, peak.row_roll);
            const Cell corner{position_with(turn.columns, region.code, turn.columns_of(region),
                                            peak.column, peak.column_roll, x_sum),
                              position_with(turn.rows, region.code, turn.rows_of(region), peak.row,
                                            peak.row_roll, y_sum)};
            best.code = region.code;
            best.quarters = quarters;
            best.place = moved(region.code, {corner, region.section},
                               BitBlock::kMiddle - turn.columns_range.first,
                               BitBlock::kMiddle - turn.rows_range.first);
            best.wrong = {best.bits / 2 - x_sum, best.bits / 2 - y_sum};
        }
    }
    return best;
}

float known_place_wrong(const Kernels& kernels, const BitBlock& block, const KnownSheets& sheets,
                        CodeVariant code, const Place& place) {
    const int bits = bits_of(block.columns);  // of each axis
    const ScoredTurn upright(kernels, block);
    const CornerPlace best{code, moved(code, place, upright.columns_range.first - BitBlock::kMiddle,
                                       upright.rows_range.first - BitBlock::kMiddle)};
    const int x_agreeing =
        upright.columns.agreeing(code, best.column().position, best.column().roll);
    const int y_agreeing = upright.rows.agreeing(code, best.row().position, best.row().roll);
    const std::array wrong{bits - x_agreeing, bits - y_agreeing};
    Confidence confidence;
    constexpr int kWeight = 127;
    confidence.add(kWeight, false, 2 * bits - wrong[0] - wrong[1]);
    confidence.add(kWeight, true, wrong[0] + wrong[1]);
    const int odds_q8 = odds_per_bit_q8(confidence);
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
            const bool is_best = !is_included && quarters == 0 && region.code == code &&
                                 region.section == best.place.section &&
                                 x.contains(best.place.cell.x) && y.contains(best.place.cell.y);
            is_included |= is_best;
            others += is_best
                          ? sum_of_others(region, turn, x_odds, y_odds, best)
                          : sum_of_odds(region, columns.of(turn.columns, region.code, x, x_odds),
                                        rows.of(turn.rows, region.code, y, y_odds));
        }
    }
    const int lines = std::max(upright.columns.count(), upright.rows.count());
    return is_included ? std::min(others + chance_of_known(sheets, bits, wrong, lines), 1.0F) : 1;
}

}  // namespace dotpose::core

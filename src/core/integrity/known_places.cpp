#include "core/integrity/known_places.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/integrity/known_lines.hpp"

namespace dotpose::core {
namespace {

/// Table of the maximum number of agreeing bits on one axis. Each element is the maximum over all
/// positions in a class. The first index is the class, which is the position modulo 63. The second
/// index is the roll that is added to the rolls in section 0.
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
    /// Returns the maximum, or 0 if the range contains no position in the class.
    int operator()(std::size_t of_class, std::size_t roll) const { return best_[of_class][roll]; }

  private:
    std::array<RollSums, kSections> best_;
};

/// Returns the first position in a class at which exactly `sum` bits agree with the code. Such a
/// position must exist. `roll` is added to the rolls in section 0.
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

/// Positions of the first column and the first row of a block and, for each axis, the number of
/// bits that agree with the code.
struct Peak {
    Cell corner;
    int x_agreeing = 0;
    int y_agreeing = 0;
};

/// Returns the place in a region where the number of agreeing bits is highest. Returns nullopt if
/// this number is at most `min_agreeing`.
std::optional<Peak> peak_on(const KnownRegion& region, const ScoredTurn& turn, const Peaks& columns,
                            const Peaks& rows, int min_agreeing) {
    struct Classes {
        std::size_t column, column_roll, row, row_roll;
    };
    std::optional<Classes> best;
    visit_classes(region.section, [&](std::size_t column, std::size_t column_roll, std::size_t row,
                                      std::size_t row_roll) {
        const int sum = columns(column, column_roll) + rows(row, row_roll);
        if (sum <= min_agreeing) return;
        min_agreeing = sum;
        best = {column, column_roll, row, row_roll};
    });
    if (!best) return {};
    const int x_sum = columns(best->column, best->column_roll);
    const int y_sum = rows(best->row, best->row_roll);
    return Peak{{position_with(turn.columns, region.code, turn.columns_of(region), best->column,
                               best->column_roll, x_sum),
                 position_with(turn.rows, region.code, turn.rows_of(region), best->row,
                               best->row_roll, y_sum)},
                x_sum,
                y_sum};
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
    best.bits = number_of_bits(block.columns) + number_of_bits(block.rows);
    if (best.bits == 0) return {};
    int agreeing = -1;
    for (int quarters = 0; quarters < kTurns; ++quarters) {
        const ScoredTurn turn(kernels, turned(quarters, block));
        KeptTable<Peaks> columns;
        KeptTable<Peaks> rows;
        for (const KnownRegion& region : sheets.regions) {
            const auto peak = peak_on(
                region, turn, columns.of(turn.columns, region.code, turn.columns_of(region)),
                rows.of(turn.rows, region.code, turn.rows_of(region)), agreeing);
            if (!peak) continue;
            agreeing = peak->x_agreeing + peak->y_agreeing;
            best.code = region.code;
            best.quarters = quarters;
            best.place = moved(region.code, {peak->corner, region.section},
                               BitBlock::kMiddle - turn.columns_range.first,
                               BitBlock::kMiddle - turn.rows_range.first);
            best.wrong = {best.bits / 2 - peak->x_agreeing, best.bits / 2 - peak->y_agreeing};
        }
    }
    return best;
}

}  // namespace dotpose::core

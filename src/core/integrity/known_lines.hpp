// Known lines: compares the columns and rows of a block with all positions on a known sheet. See
// docs/integrity.md, "Known sheets".
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "code/rolls.hpp"
#include "code/tables.hpp"
#include "core/decode/bit_lines.hpp"
#include "core/kernels/kernels.hpp"
#include "core/known_sheets.hpp"

namespace dotpose::core {

/// Number of possible orientations of the pattern in a block. They differ by quarter turns.
inline constexpr int kTurns = 4;

/// Returns the class of a position, which is the position modulo 63.
inline std::size_t class_of(std::uint32_t position) {
    return code::modulo_sections(position);
}

/// Returns the sum of two rolls, modulo 63.
inline std::size_t sum_of_rolls(std::size_t a, std::size_t b) {
    const std::size_t sum = a + b;
    return sum < kSections ? sum : sum - kSections;
}

int number_of_bits(const BitLines& lines);

/// The lines on one axis of a block. Contains, for each line and each roll, the number of bits that
/// agree with the code.
class ScoredAxis {
  public:
    ScoredAxis(const Kernels& kernels, const BitLines& lines, const LineRange& range,
               int first_cell);

    int count() const { return scores_.count; }

    /// Returns the number of bits that agree with the code if the first line is at `position`. The
    /// roll of each line is its roll in section 0 plus `added`.
    int agreeing(CodeVariant code, std::uint32_t position, std::size_t added) const;

    /// Calls `use(position, sums)` for each position in `range`. sums[r] is the number of bits that
    /// agree with the code if the first line is at `position` and the roll of each line is its roll
    /// in section 0 plus r. The true r depends on the section and on the position along the other
    /// axis.
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

/// The scored lines of a block in one orientation. `upright` is the block after rotation.
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

    /// Returns the range of positions that the block's first column can have if the block overlaps
    /// the columns of `region`.
    PositionRange columns_of(const KnownRegion& region) const {
        return {region.first.x, region.columns, columns.count()};
    }
    /// Returns the range of positions that the block's first row can have if the block overlaps the
    /// rows of `region`.
    PositionRange rows_of(const KnownRegion& region) const {
        return {region.first.y, region.rows, rows.count()};
    }
};

/// Caches the table of one axis, because sheets in one file often have the same positions on one
/// axis. If the code and the range of positions are the same as in the previous call, `of` returns
/// the same table. Otherwise, it computes a new table. Every call to `of` must pass the same `axis`
/// and `rest`.
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

/// Calls `use(column, column_roll, row, row_roll)` for each pair of a column class and a row class.
/// The class of a column or row is its position modulo 63. The roll of a column is its roll in
/// section 0 plus `column_roll`, which depends on the section and the row class. The roll of a row
/// is its roll in section 0 plus `row_roll`, which depends on the section and the column class.
template <typename Use>
void visit_classes(const Section& section, Use use) {
    for (std::size_t column = 0; column < kSections; ++column) {
        const std::size_t row_roll = sum_of_rolls(section.v, column);
        for (std::size_t row = 0; row < kSections; ++row)
            use(column, sum_of_rolls(section.u, row), row, row_roll);
    }
}

}  // namespace dotpose::core

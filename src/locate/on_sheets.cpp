#include "locate/on_sheets.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/integrity/certainty.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

/// Returns the hard bits of the cells in `region`. Omits a cell if the weight of either bit is
/// below kMinWeight. Cell (0, 0) of the block is cell `middle` of the grid.
BitBlock bits_of(const Grid& grid, const GridRegion& region, FixedVec middle) {
    BitBlock block;
    const auto is_clear = [](int weight) { return std::abs(weight) >= tuning::known::kMinWeight; };
    for (int j = region.j0; j < region.j0 + region.rows; ++j) {
        for (int i = region.i0; i < region.i0 + region.columns; ++i) {
            const auto column = static_cast<std::size_t>(i - middle.x + BitBlock::kMiddle);
            const auto row = static_cast<std::size_t>(j - middle.y + BitBlock::kMiddle);
            const GridCell& cell = grid.at(i, j);
            if (std::max(column, row) >= BitBlock::kSide || !is_clear(cell.x) || !is_clear(cell.y))
                continue;
            block.columns.valid[column] |= std::uint64_t{1} << row;
            block.columns.bits[column] |= std::uint64_t{cell.x > 0} << row;
            block.rows.valid[row] |= std::uint64_t{1} << column;
            block.rows.bits[row] |= std::uint64_t{cell.y > 0} << column;
        }
    }
    return block;
}

/// Returns the cell to which `turned(quarters, block)` moves cell (0, 0).
FixedVec origin_after(int quarters) {
    return {quarters == 1 || quarters == 2 ? -1 : 0, quarters >= 2 ? -1 : 0};
}

}  // namespace

bool is_possible(CodeVariant code, const Decoding& decoding, const KnownSheets& known) {
    if (!known.are_all()) return true;
    const GridRegion& region = decoding.region;
    const QuarterTurn& turn = decoding.pattern_from_grid;
    const FixedVec a = turn({region.i0, region.j0});
    const FixedVec b = turn({region.i0 + region.columns - 1, region.j0 + region.rows - 1});
    const Place corner = moved(code, decoding.place, std::min(a.x, b.x), std::min(a.y, b.y));
    return known.show(code, corner, std::abs(b.x - a.x) + 1, std::abs(b.y - a.y) + 1);
}

std::optional<KnownPlace> find_place_on_sheets(const Kernels& kernels, const DeviceOptions& options,
                                               const BitBlock& block, const KnownSheets& known) {
    const auto found = find_known_place(kernels, block, known);
    const bool explains_bits =
        found && found->code == options.code && found->is_plausible(options.integrity);
    return explains_bits ? found : std::nullopt;
}

bool is_certain_on_sheets(const Kernels& kernels, const DeviceOptions& options, const Place& place,
                          const BitBlock& block, const KnownSheets& known, Fix& fix) {
    const float wrong = known_place_wrong(kernels, block, known, options.code, place,
                                          options.integrity.bits_per_error);
    if (!is_within_limit(wrong, options.integrity.max_p_wrong_log2, fix)) return false;
    fix.prior = known.are_all() ? Prior::only_sheets : Prior::sheets;
    return true;
}

bool read_on_sheets(const Kernels& kernels, const DeviceOptions& options, const Grid& grid,
                    const KnownSheets& known, Decoding& decoding, Fix& fix) {
    const GridRegion& region = decoding.region;
    const FixedVec middle{region.i0 + region.columns / 2, region.j0 + region.rows / 2};
    const BitBlock block = bits_of(grid, region, middle);
    const auto found = find_place_on_sheets(kernels, options, block, known);
    if (!found) return false;
    fix.bit_errors = found->wrong[0] + found->wrong[1];
    if (!is_certain_on_sheets(kernels, options, found->place, turned(found->quarters, block), known,
                              fix)) {
        return false;
    }
    const QuarterTurn turn{found->quarters};
    const FixedVec to_origin = origin_after(found->quarters) - turn(middle);
    decoding.pattern_from_grid = turn;
    decoding.place = moved(options.code, found->place, to_origin.x, to_origin.y);
    decoding.bits = found->bits;
    decoding.lines_are_scored = false;
    return true;
}

}  // namespace dotpose::core

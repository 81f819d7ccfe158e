#include "core/decode/nominal.hpp"

#include "code/rolls.hpp"
#include "code/tables.hpp"

namespace dotpose::core {
Nominal::Nominal(const Grid& grid, CodeVariant code, const Decoding& decoding)
    : turn_(decoding.pattern_from_grid) {
    const FixedVec a = pattern_step({grid.i0, grid.j0});
    const FixedVec b = pattern_step({grid.i0 + grid.columns - 1, grid.j0 + grid.rows - 1});
    first_ = {std::min(a.x, b.x), std::min(a.y, b.y)};
    const Place corner = moved(code, decoding.place, first_.x, first_.y);
    const auto follow = [&](std::uint32_t position, int section, std::uint32_t cross, int count,
                            std::array<std::uint8_t, kMaxGridSide>& indices) {
        code::follow_rolls(code, position, section, cross,
                           std::span(indices).first(static_cast<std::size_t>(count)));
    };
    follow(corner.cell.x, corner.section.u, corner.cell.y, std::max(a.x, b.x) - first_.x + 1,
           columns_);
    follow(corner.cell.y, corner.section.v, corner.cell.x, std::max(a.y, b.y) - first_.y + 1,
           rows_);
}

Symbol Nominal::symbol(FixedVec pattern_step) const {
    const auto column = static_cast<std::size_t>(pattern_step.x - first_.x);
    const auto row = static_cast<std::size_t>(pattern_step.y - first_.y);
    return make_symbol(code::kMainRepeated[columns_[column] + row],
                       code::kMainRepeated[rows_[row] + column]);
}

}  // namespace dotpose::core

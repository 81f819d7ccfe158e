#include "core/decode/nominal.hpp"

namespace dotpose::core {
namespace {

/// Rolls of the columns from `position` on, the first of which has roll `value`. Stepping by
/// differences carries over the end of the code.
void fill_rolls(Profile profile, std::uint32_t position, int value, int count,
                std::array<std::uint8_t, kMaxGridSide>& rolls) {
    for (int i = 0; i < count; ++i) {
        rolls[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value % kSections);
        value = (value + delta(profile, position)) % kSections;
        position = position + 1 == kPositionsPerAxis ? 0 : position + 1;
    }
}

}  // namespace

Nominal::Nominal(const Grid& grid, Profile profile, const Decoding& decoding)
    : turn_(decoding.pattern_from_grid) {
    const Vec a = pattern_step({grid.i0, grid.j0});
    const Vec b = pattern_step({grid.i0 + grid.columns - 1, grid.j0 + grid.rows - 1});
    first_ = {std::min(a.x, b.x), std::min(a.y, b.y)};
    const Place corner = moved(profile, decoding.place, first_.x, first_.y);
    first_x_ = corner.cell.x;
    first_y_ = corner.cell.y;
    fill_rolls(profile, first_x_, roll(profile, first_x_) + corner.section.u,
               std::max(a.x, b.x) - first_.x + 1, column_rolls_);
    fill_rolls(profile, first_y_, roll(profile, first_y_) + corner.section.v,
               std::max(a.y, b.y) - first_.y + 1, row_rolls_);
}

Symbol Nominal::symbol(Vec pattern_step) const {
    const Vec step = pattern_step - first_;
    const std::uint32_t column = column_rolls_[static_cast<std::size_t>(step.x)];
    const std::uint32_t row = row_rolls_[static_cast<std::size_t>(step.y)];
    return make_symbol(main_bit(column + first_y_ + static_cast<std::uint32_t>(step.y)),
                       main_bit(row + first_x_ + static_cast<std::uint32_t>(step.x)));
}

}  // namespace dotpose::core

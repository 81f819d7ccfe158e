#include "device/coded_cells.hpp"

#include <array>
#include <span>

#include "code/rolls.hpp"
#include "code/tables.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {

void lay_tracked_lines(CodeVariant code, Tracking& tracking) {
    const Place& corner = tracking.corner;
    const auto first = static_cast<std::uint32_t>(tracking.first_cell);
    const auto count = static_cast<std::size_t>(tracking.last_cell - tracking.first_cell + 1);
    const auto lay = [&](std::uint32_t position, int section, std::uint32_t cross,
                         std::span<ComparedLine> lines) {
        std::array<std::uint8_t, kMaxComparedLines> rolls;
        code::follow_rolls(code, position + first,
                           code::roll_from(code, position + first, section, cross),
                           std::span(rolls).first(count));
        for (std::size_t i = 0; i < count; ++i)
            lines[first + i].code = code::kMainWords[rolls[i]];
    };
    lay(corner.cell.x, corner.section.u, corner.cell.y, tracking.lines.first(kMaxComparedLines));
    lay(corner.cell.y, corner.section.v, corner.cell.x, tracking.lines.last(kMaxComparedLines));
}

int dots_seen(const Tracking& tracking) {
    int seen = 0;
    for (int i = tracking.first_cell; i <= tracking.last_cell; ++i)
        seen += bits_in(column_of(tracking, i).seen);
    return seen;
}

Projections projections(const Tracking& tracking, FixedVec from_intersection_q8) {
    const FixedVec d = from_intersection_q8;
    const std::int32_t x_q12 = (tracking.du_q20.x * d.x + tracking.dv_q20.x * d.y) >> 16;
    const std::int32_t y_q12 = (tracking.du_q20.y * d.x + tracking.dv_q20.y * d.y) >> 16;
    return {y_q12 - x_q12, y_q12 + x_q12};
}

}  // namespace dotpose::core

#include "device/coded_cells.hpp"

#include <array>
#include <span>

#include "code/rolls.hpp"
#include "code/tables.hpp"
#include "core/math/fixed.hpp"

namespace dotpose::core {

void lay_tracked_lines(CodeVariant code, Tracking& tracking) {
    const Place& corner = tracking.corner;
    const auto lay = [&](std::uint32_t position, int section, std::uint32_t cross,
                         std::span<ComparedLine> lines) {
        std::array<std::uint8_t, kMaxComparedLines> rolls;
        code::follow_rolls(code, position, code::roll_from(code, position, section, cross), rolls);
        for (std::size_t i = 0; i < rolls.size(); ++i)
            lines[i].code = code::kMainWords[rolls[i]];
    };
    lay(corner.cell.x, corner.section.u, corner.cell.y, tracking.lines.first(kMaxComparedLines));
    lay(corner.cell.y, corner.section.v, corner.cell.x, tracking.lines.last(kMaxComparedLines));
}

int dots_seen(const Tracking& tracking) {
    int seen = 0;
    for (const ComparedLine& column : tracking.lines.first(kMaxComparedLines))
        seen += bits_in(column.seen);
    return seen;
}

Projections projections(const Tracking& tracking, FixedVec from_intersection_q8) {
    const FixedVec d = from_intersection_q8;
    const std::int32_t x_q12 = (tracking.du_q20.x * d.x + tracking.dv_q20.x * d.y) >> 16;
    const std::int32_t y_q12 = (tracking.du_q20.y * d.x + tracking.dv_q20.y * d.y) >> 16;
    return {y_q12 - x_q12, y_q12 + x_q12};
}

}  // namespace dotpose::core
